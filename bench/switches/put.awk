# SPDX-License-Identifier: MIT
# Puts the rows of a printed table into the table of a page, between its marks. Rows with the name of a
# new one go, and all if they were measured on other volumes. The rows are in the order of their names.
# Usage: awk -v on='VOLUMES' -v day=YYYY-MM-DD -f put.awk PRINTED.md PAGE.md (prints the new page)

function name_of(row) {
  return substr(row, 3, index(substr(row, 3), " |") - 1)
}
function put(row) {
  name = name_of(row)
  if (!(name in rows)) names[++count] = name
  rows[name] = row
}
function print_table(   n, m, name) {
  print "Measured on " on "; the last on " day ".\n\n" heading "\n" ruler
  for (n = 2; n <= count; n++) {
    name = names[n]
    for (m = n; m > 1 && names[m - 1] > name; m--) names[m] = names[m - 1]
    names[m] = name
  }
  for (n = 1; n <= count; n++) print rows[names[n]]
}
FNR == NR { gsub(/ +/, " ") }
FNR == NR && /^\| switch / { heading = $0 }
FNR == NR && /^\| -/ { gsub(/-+/, "---"); ruler = $0 }
FNR == NR && /^\| [a-z(]/ && !/^\| switch / { new[name_of($0)] = $0 }
FNR == NR { next }
/^<!--switches-->$/ { inside = 1 }
inside && /^Measured on / { is_same = index($0, "Measured on " on ";") == 1 }
inside && is_same && /^\| [a-z(]/ && !/^\| switch / { put($0) }
/^<!--end of switches-->$/ {
  for (name in new) put(new[name])
  print_table()
  inside = 0
}
inside && !/^</ { next }
{ print }

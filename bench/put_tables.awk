# SPDX-License-Identifier: MIT
# Puts the tables that programs printed into a page.
# Usage: awk -v measured=LINE -f put_tables.awk PAGE.md PRINTED.md... (prints the new page)
# A table stands under its title, a line in bold. Of a printed table the page gets the columns of its
# own header, in their order, and its own rows. A row is known by its cells up to the first number.
# The line that begins with "Measured on" becomes LINE. A table, column or row of the page that no
# program printed is an error.

function error(what) {
  print "put_tables.awk: " what >"/dev/stderr"
  failed = 1
  exit 1
}
function cells_of(row, cells,   n, count) {
  sub(/^\| */, "", row)
  sub(/ *\|$/, "", row)
  count = split(row, cells, / *\| */)
  return count
}
# Of the columns chosen by `chosen`, the words before the first number.
function name_of(cells, chosen, columns,   n, name) {
  for (n = 1; n <= columns && cells[chosen[n]] !~ /^-?[0-9.]/; n++) name = name "|" cells[chosen[n]]
  return name
}
function put_header(title,   theirs, count, n, m) {
  if (printed[title, 1] == "") error("no program printed " title)
  columns = cells_of($0, wanted)
  count = cells_of(printed[title, 1], theirs)
  m = 0
  for (n = 1; n <= columns; n++) {
    do m++
    while (m <= count && theirs[m] != wanted[n])
    if (m > count) error("no column \"" wanted[n] "\" under " title)
    chosen[n] = m
    same[n] = n
  }
}
function put_row(title,   theirs, n, line, row) {
  cells_of($0, wanted)
  for (row = 3; printed[title, row] != ""; row++) {
    cells_of(printed[title, row], theirs)
    if (name_of(theirs, chosen, columns) != name_of(wanted, same, columns)) continue
    line = "|"
    for (n = 1; n <= columns; n++) line = line " " theirs[chosen[n]] " |"
    return line
  }
  error("no row \"" $0 "\" under " title)
}

# The page is read first and kept.
FILENAME == ARGV[1] { page[++lines] = $0; next }
/^\*\*.*\*\*$/ { title = $0; rows = 0; next }
/^\|/ { printed[title, ++rows] = $0 }
END {
  if (failed) exit 1
  for (k = 1; k <= lines; k++) {
    $0 = page[k]
    if (/^\*\*.*\*\*$/) { title = $0; rows = 0 }
    if (/^#/) title = ""
    if (/^Measured on /) $0 = measured
    if (/^\|/ && title != "") {
      if (++rows == 1) put_header(title)
      else if (rows > 2) $0 = put_row(title)
    }
    print
  }
}

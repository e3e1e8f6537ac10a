# SPDX-License-Identifier: MIT
# Do the records of a page, the table of another and the switches fit together? Each record (###) has a
# paragraph "**Switch.**" or "**Switches.**" with names in backticks, or "**No switch.**" that says why,
# or its folder (##) has that before the first record. Each switch is named by its record, and has a row
# between the marks of the table, and no other row.
# Usage: awk -v patches='NAME<tab>RECORD, a line each' -f check.awk RECORDS.md TABLE.md

function wrong(what) {
  print what
  failed = 1
}
function end_record() {
  if (title != "" && !told && !folder_told) wrong("\"" title "\": names no switch, and does not say why")
  told = 0
}
BEGIN {
  lines = split(patches, line, "\n")
  for (n = 1; n <= lines; n++) {
    split(line[n], field, "\t")
    record[field[1]] = field[2]
  }
}
/^##/ { end_record(); title = "" }
/^## / { folder_told = 0 }
/^### / { title = substr($0, 5) }
/^$/ { names = 0 }
/^\*\*No switch\.\*\* ./ { if (title == "") folder_told = 1; else told = 1 }
/^\*\*Switch(es)?\.\*\*/ { told = names = 1 }
names {
  count = split($0, word, "`")
  for (n = 2; n <= count; n += 2) {
    if (!(word[n] in record)) wrong("\"" title "\": there is no switch " word[n])
    else if (record[word[n]] == title) named[word[n]] = 1
  }
}
/^<!--switches-->$/, /^<!--end of switches-->$/ {
  if (!/^\| [a-z(]/ || $2 == "switch" || $2 == "(none)") next
  row[$2] = 1
  if (!($2 in record)) wrong("the table has a row " $2 ", and there is no such switch")
}
END {
  end_record()
  for (name in record) {
    if (!(name in named)) wrong(name ": its record, \"" record[name] "\", does not name it")
    if (!(name in row)) wrong(name ": the table has no row of it; make switches ONLY=" name)
  }
  exit failed
}

#!/bin/sh
# SPDX-License-Identifier: MIT
# Every work that the sources or the pages cite by name and year is in docs/bibliography.md.
# Usage: bibliography.sh SOURCE
set -eu
cd "$1"
# "Name 1990", "Name et al. 1990", "Name (1990": of several authors the last. A citation may be broken
# between two lines of a comment. Standards and dates are none.
cited=$(find src more deliso check io view app c bench figures tests docs README.md \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.js' -o -name '*.html' -o -name '*.md' \) ! -name bibliography.md \
  -exec sh -c 'sed "s|^ *//* *||" "$@" | tr "\n" " "' sh {} + |
  grep -oE "[A-Z][A-Za-z]+( et al\.)? \(?(19|20)[0-9]{2}[^0-9A-Za-z./-]" |
  sed 's/ et al\.//; s/(//; s/.$//' | grep -vE '^(RFC|JPEG|November) ' | sort -u)
count=0
faults=0
while read -r name year; do
  count=$((count + 1))
  grep -q "^- \*\*.*\<$name $year\|^- \*\*.*\<$name et al\. $year" docs/bibliography.md ||
    { echo "FAULT: docs/bibliography.md has no $name $year"; faults=1; }
done <<END
$cited
END
echo "$count works cited"
[ "$count" -ge 40 ] && [ "$faults" -eq 0 ]

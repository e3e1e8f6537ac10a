#!/bin/sh
# SPDX-License-Identifier: MIT
# The tables of docs/guide/how-small.md on tiny surfaces and built-in fields are those of this program. Those
# of volumes need data: build/bench/how_small --data FOLDER --markdown.
# Usage: how_small.sh SOURCE HOW_SMALL
set -eu
page=$1/docs/guide/how-small.md
rows=0
faults=0
# As it stands in the page, where columns are as wide as their words.
plain() { tr -s ' -' | sed 's/ |/|/g; s/| /|/g'; }
told=$("$2" --markdown | grep '^|' | plain)
stands=$(plain <"$page")
while read -r row; do
  rows=$((rows + 1))
  echo "$stands" | grep -qxF -e "$row" || { echo "docs/guide/how-small.md lacks $row"; faults=1; }
done <<END
$told
END
echo "$rows rows"
[ "$rows" -ge 20 ] && [ "$faults" -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# The code that pages show is that of the sources. A block below `<!-- code: FILE NAME... -->` has the definitions
# of these names in FILE, a path as docs/guide/reading.md has it; reading.awk finds and prints them.
# Usage: code.sh show FILE NAME...   prints such a block
#        code.sh write PAGE...       writes the blocks of the pages
# run_blocks.sh compares.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

show() {
  case $1 in deliso/* | more/* | check/*) file=$here/../../$1 ;; *) file=$here/../../src/$1 ;; esac
  [ -f "$file" ] || { echo "no file $1" >&2; return 1; }
  echo "// ${file#"$here/../../"}"
  shift
  for name; do
    [ "$(awk -v name="$name" -f "$here/reading.awk" "$file")" -gt 0 ] ||
      { echo "${file##*/} does not define $name" >&2; return 1; }
    [ "$name" = "$1" ] || echo
    awk -v name="$name" -v show=source -f "$here/reading.awk" "$file"
  done
}

write() {
  for page; do
    awk -v command="sh '$here/code.sh' show " '
      marked { if (/^```cpp$/) {
                 print
                 failed = system(command names)
                 while (!failed && (getline) > 0 && !/^```$/) continue
               }
               if (failed || !/^```$/) exit 1
               marked = 0 }
      /^<!-- code: .* -->$/ { marked = 1; names = $0; gsub(/^<!-- code: | -->$/, "", names) }
      { print; fflush() }' "$page" >"$page.new" || { rm "$page.new"; echo "$page is as it was" >&2; return 1; }
    if cmp -s "$page" "$page.new"; then rm "$page.new"; else mv "$page.new" "$page" && echo "$page"; fi
  done
}

"$@"

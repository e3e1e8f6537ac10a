#!/bin/sh
# SPDX-License-Identifier: MIT
# The lines of src, more, deliso and check that no quick test reaches, from a build with --coverage
# whose tests have run (make coverage). A line that no quick test can reach says so: "// unreachable: why".
# Exit status 1: there are others. Usage: coverage.sh PROJECT BUILD
set -eu
project=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# gcov prints a source once for each object that has code of it: a line counts once any of them ran it.
find "$build" -name '*.gcda' | sort | while read -r data; do
  gcov --stdout "$data" 2>/dev/null || true
done | awk -v root="$project/" '
  / 0:Source:/ {
    file = substr($0, index($0, "0:Source:") + 9)
    is_ours = index(file, root) == 1
    file = substr(file, length(root) + 1)
    is_ours = is_ours && file ~ /^(src|more|deliso|check)\//
    next
  }
  !is_ours { next }
  {
    count = $0
    sub(/:.*/, "", count)
    gsub(/[ *]/, "", count)
    # "=": of the line an exception alone runs something, which is the compiler'"'"'s.
    if (count == "-" || count == "" || count ~ /^[-=]+$/) next
    line = substr($0, index($0, ":") + 1)
    number = line
    sub(/:.*/, "", number)
    number += 0
    if (number == 0 || line ~ /^ *[0-9]+: *\}[);]*$/) next
    key = file ":" number
    if (!(key in text)) {
      text[key] = substr(line, index(line, ":") + 1)
      split(file, part, "/")
      room[key] = part[2] ~ /\./ ? part[1] : part[1] "/" part[2]
    }
    if (count !~ /^#/) hit[key] = 1
  }
  END {
    for (key in text) {
      ++lines[room[key]]
      if (key in hit) { ++reached[room[key]]; continue }
      # A mark is of its line, and of the statement that follows.
      place = key
      sub(/:[0-9]*$/, "", place)
      sub(/.*:/, "", key)
      is_marked = 0
      for (n = key; n >= key - 4; --n) is_marked = is_marked || text[place ":" n] ~ /\/\/ unreachable: /
      key = place ":" key
      if (is_marked) { ++marked; continue }
      print "MISSED " key ":" text[key]
    }
    for (r in lines) printf "ROOM %-16s %6d of %6d lines, %6.2f %%\n", r, reached[r], lines[r], 100 * reached[r] / lines[r]
    printf "MARKED %d\n", marked
  }' >"$work/all"
sed -n 's/^MISSED //p' "$work/all" | sort -t: -k1,1 -k2,2n
sed -n 's/^ROOM //p' "$work/all" | sort
missed=$(grep -c '^MISSED' "$work/all" || true)
echo "$missed lines missed, $(sed -n 's/^MARKED //p' "$work/all") unreachable"
[ "$missed" = 0 ]

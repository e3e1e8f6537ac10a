#!/bin/sh
# SPDX-License-Identifier: MIT
# What docs/guide/reading.md lists is there, and is short enough to be read: at most 2,000 lines. A
# row of its tables links a file of src/, and names functions or classes of it (reading.awk).
# Usage: reading.sh SOURCE
set -eu
cd "$1"
page=docs/guide/reading.md
most=2000
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# lines FILE NAME: how many lines the definition has.
lines() { awk -v name="$2" -f tests/docs/reading.awk "$1"; }

# It counts what is a definition, and that alone.
cat >"$work/code.cpp" <<'END'
int f(int n);
// f(2) {
struct A {
  A() : n(f(1)), m{2} {
    n = '{';
  }
  int n, m;
};
int f(int n) {
  if (A::g(n)) {
    f("{");
  }
  return n;
}
END
for row in 'f 6' 'A 3' 'class A 6' 'A::g 0' 'file 14'; do
  got=$(lines "$work/code.cpp" "${row% *}")
  [ "$got" -eq "${row##* }" ] || { echo "FAULT: reading.awk counts $got lines of ${row% *}"; exit 1; }
done

# FILE <tab> NAME, a line each.
awk -F '|' '/^\| \[[a-z_0-9\/]+\.(h|cpp)\]\(/ {
  gsub(/^ \[|\].*/, "", $2)
  n = split($3, part, "`")
  for (m = 2; m <= n; m += 2) print $2 "\t" part[m]
}' $page >"$work/list"
total=0
faults=0
while IFS='	' read -r file name; do
  count=0
  if [ ! -f "src/$file" ]; then
    echo "FAULT: $page: no src/$file"
    faults=$((faults + 1))
    continue
  fi
  count=$(lines "src/$file" "$name")
  if [ "$count" -eq 0 ]; then
    echo "FAULT: $page: src/$file does not define $name"
    faults=$((faults + 1))
  fi
  printf '%5d %s %s\n' "$count" "$file" "$name"
  total=$((total + count))
done <"$work/list"
echo "$(wc -l <"$work/list") definitions, $total lines, $faults faults"
[ "$total" -le $most ] || { echo "FAULT: $page lists $total lines: over $most"; exit 1; }
[ "$total" -ge 1000 ] && [ "$faults" -eq 0 ]

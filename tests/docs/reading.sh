#!/bin/sh
# SPDX-License-Identifier: MIT
# What docs/guide/reading.md lists is there, and each of its lists is short enough to be read: a list
# says "At most N lines". A row of its tables links a file of src/, more/, deliso/ or check/, and names functions or classes of
# it (reading.awk). The list of the paper has every function of src/paper of more than three lines.
# README.md says how many lines all lists have.
# Of each list it is counted which functions of its rooms a listed one calls that no list has.
# Usage: reading.sh SOURCE
set -eu
cd "$1"
page=docs/guide/reading.md
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

# LIST <tab> MOST <tab> FILE <tab> NAME, a line each.
awk -F '|' '
/^## / { list = substr($0, 4); most = 0 }
/^At most [0-9]+ lines/ { split($0, word, " "); most = word[3] }
/^\| \[[a-z_0-9\/]+\.(h|cpp)\]\(/ {
  gsub(/^ \[|\].*/, "", $2)
  n = split($3, part, "`")
  for (m = 2; m <= n; m += 2) print list "\t" most "\t" $2 "\t" part[m]
}' $page >"$work/list"

faults=0
fault() {
  echo "FAULT: $*"
  faults=$((faults + 1))
}
# The functions defined in a room: FILE <tab> NAME, with their class where it stands there.
defined() {
  awk '/^[A-Za-z].*\(/ && !/;$/ && !/^(namespace|class|struct|using|template|static_assert|#)/ {
    line = $0
    sub(/\(.*/, "", line)
    sub(/.*[ &*]/, "", line)
    if (line ~ /^([A-Za-z_]+::)*[a-z_]+$/) print FILENAME "\t" line
  }' "$(in_tree "$1")"/*.cpp | sort -u
}
# The path of a room or a file: the trees beside src/ go by their names in full.
in_tree() {
  case $1 in deliso | deliso/* | more/* | check | check/*) echo "$1" ;; *) echo "src/$1" ;; esac
}

all=0
cut -f 1 "$work/list" | uniq >"$work/lists"
cut -f 4 "$work/list" | sed 's/^class //' | sort -u >"$work/listed"
while read -r list; do
  awk -F '\t' -v list="$list" '$1 == list' "$work/list" >"$work/rows"
  total=0
  most=$(head -n 1 "$work/rows" | cut -f 2)
  : >"$work/text"
  while IFS='	' read -r _ _ file name; do
    count=0
    at=$(in_tree "$file")
    if [ -f "$at" ]; then count=$(lines "$at" "$name"); else fault "$page: no $at"; fi
    [ "$count" -gt 0 ] || fault "$page: $at does not define $name"
    awk -v name="$name" -v show=1 -f tests/docs/reading.awk "$at" >>"$work/text"
    total=$((total + count))
  done <"$work/rows"
  all=$((all + total))
  [ "$most" -gt 0 ] || fault "$page: $list does not say how many lines it has at most"
  [ "$total" -le "$most" ] || fault "$page: $list has $total lines, over $most"
  # The names that are called, and which of them are functions of the same rooms that no list has.
  grep -oE '[a-z_]+\(' "$work/text" | tr -d '(' | sort -u >"$work/called"
  : >"$work/calls"
  for room in $(cut -f 3 "$work/rows" | sed 's|/[^/]*$||' | sort -u); do
    defined "$room" | while IFS='	' read -r file name; do
      grep -qxF "$name" "$work/listed" && continue
      grep -qxF "${name##*:}" "$work/called" || [ "$room" = paper ] || continue
      [ "$(lines "$file" "$name")" -gt 3 ] && echo "$room/${file##*/} $name"
    done >>"$work/calls" || true
  done
  echo "$list: $(wc -l <"$work/rows") definitions, $total of at most $most lines, $(wc -l <"$work/calls") unlisted functions called"
  sed 's/^/    /' "$work/calls"
  case $list in *paper*) [ ! -s "$work/calls" ] || fault "$page: the list of the paper has not all of src/paper" ;; esac
done <"$work/lists"
# The README says how many they are, to the next hundred.
told=$(grep -oE 'code in [0-9,]+ lines' README.md | tr -cd 0-9)
[ "$all" -le "$told" ] && [ "$all" -gt $((told - 100)) ] || fault "README.md says $told lines, and the lists have $all"
echo "$all lines, $faults faults"
[ "$(wc -l <"$work/list")" -ge 60 ] && [ "$faults" -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# Every chapter of the guide that has exercises has three, each answered by a test case that is
# there under the name that the chapter gives.
# Usage: exercises.sh SOURCE
set -eu
cd "$1"
faults=0
chapters=0
say() {
  echo "$1"
  faults=1
}
# One line of words each, however it was broken.
flat() { tr -s ' \n' '  ' <"$1"; }

for page in docs/guide/*.md; do
  grep -q '^## Exercises' "$page" || continue
  chapters=$((chapters + 1))
  answers=$(flat "$page" | grep -o 'Answered by\* `[^`]*`: "[^"]*"' || true)
  [ "$(echo "$answers" | wc -l)" -eq 3 ] || say "$page: not three answers"
  echo "$answers" | while IFS= read -r answer; do
    file=$(echo "$answer" | cut -d '`' -f 2)
    name=$(echo "$answer" | cut -d '"' -f 2)
    [ -f "$file" ] || { echo "$page: no file $file"; exit 1; }
    flat "$file" | sed 's/TEST_CASE( "/TEST_CASE("/g' | grep -qF "TEST_CASE(\"$name\")" ||
      { echo "$page: no test case \"$name\" in $file"; exit 1; }
  done || faults=1
done
echo "$chapters chapters with exercises"
[ "$chapters" -gt 0 ] && [ "$faults" -eq 0 ]

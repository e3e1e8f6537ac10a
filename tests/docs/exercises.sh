#!/bin/sh
# SPDX-License-Identifier: MIT
# The page of the paper and every chapter of the guide that has exercises has three, each with a worked answer. Each is
# answered by a test case that is there under the name that the chapter gives. docs/proof.md names a
# test case for each of C1 to C4.
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

for page in docs/paper.md docs/guide/*.md; do
  grep -q '^## Exercises' "$page" || continue
  chapters=$((chapters + 1))
  answers=$(flat "$page" | grep -o 'Answered by\* `[^`]*`: "[^"]*"' || true)
  [ "$(echo "$answers" | wc -l)" -eq 3 ] || say "$page: not three answers"
  # Folded below the test's name: the summary, a blank line, text, and the end.
  worked=$(awk '/^## Exercises/ { inside = 1; next }
                !inside { next }
                /^[1-9]\. / { named = 0 }
                /Answered by/ { named = 1 }
                named && /^   <details><summary>Answer<\/summary>$/ { named = 0; words = 0; folded = 1; next }
                folded && /^   <\/details>$/ { answers += words > 10; folded = 0 }
                folded { words += NF }
                END { print answers + 0 }' "$page")
  [ "$worked" -eq 3 ] || say "$page: $worked worked answers, not three"
  echo "$answers" | while IFS= read -r answer; do
    file=$(echo "$answer" | cut -d '`' -f 2)
    name=$(echo "$answer" | cut -d '"' -f 2)
    [ -f "$file" ] || { echo "$page: no file $file"; exit 1; }
    flat "$file" | sed 's/TEST_CASE( "/TEST_CASE("/g' | grep -qF "TEST_CASE(\"$name\"" ||
      { echo "$page: no test case \"$name\" in $file"; exit 1; }
  done || faults=1
done
for condition in C1 C2 C3 C4; do
  name=$(flat docs/proof.md | grep -o "\"$condition: [^\"]*\"" || true)
  grep -qF "TEST_CASE(${name:-none})" tests/recover/test_certificate.cpp ||
    say "docs/proof.md: no test case for $condition"
done
echo "$chapters chapters with exercises"
[ "$chapters" -gt 0 ] && [ "$faults" -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs the exercises, and prints a table: how many of the project's test cases pass. Of one
# exercise alone it shows what the compiler and the test say, too. A program has 10 s of processor time.
# Exit status 1 unless all pass. Usage: grade.sh BUILD [EXERCISE]
set -u
build=$1
only=${2:-}
course=$build/course
tab=$(printf '\t')

if [ -n "$only" ] && ! grep -q "^$only$tab" "$course/exercises"; then
  echo "grade.sh: no exercise '$only': $(cut -f 1 "$course/exercises" | paste -sd' ' -)" >&2
  exit 2
fi
unsolved=0
printf '%-20s %-14s %s\n' exercise 'cases passed' seconds
while IFS=$tab read -r name cases; do
  [ -z "$only" ] || [ "$name" = "$only" ] || continue
  log=$course/$name.log
  seconds=
  solved=false
  if cmake --build "$build" --target "course_$name" >"$log" 2>&1; then
    count=$("$course/course_$name" "-tc=$cases" --count | sed -n 's/.* filters: *//p')
    status=0
    (
      ulimit -t 10
      "$course/course_$name" "-tc=$cases" >"$log" 2>&1
      status=$?
      times >"$course/times"
      exit "$status"
    ) 2>/dev/null || status=$?
    seconds=$(sed -n '2s/^0m\([0-9]*\.[0-9]\).*/\1/p' "$course/times")
    passed=$(sed -n 's/.*test cases: *[0-9]* | *\([0-9]*\) passed.*/\1/p' "$log")
    outcome="${passed:-0} of $count"
    if [ "$status" -eq 0 ] && [ "$count" -gt 0 ] && [ "$passed" = "$count" ]; then solved=true; fi
    [ "$status" -ne 137 ] || outcome='over 10 s'  # killed
  else
    outcome='does not build'
  fi
  $solved || unsolved=$((unsolved + 1))
  printf '%-20s %-14s %s\n' "$name" "$outcome" "$seconds"
  [ -z "$only" ] || cat "$log"
done <"$course/exercises"
[ "$unsolved" -gt 0 ] || exit 0
[ -n "$only" ] || echo 'make grade EXERCISE=NAME shows what is wrong'
exit 1

#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs the exercises, and prints a table: how many of the project's test cases pass. Of one
# exercise alone it shows what the compiler and the test say, too. A program has 10 s of processor time
# and 60 s of the clock (DELISO_GRADE_SECONDS), and nothing to read. What it prints is shown, but the
# score is read from the file that the tests write. With DELISO_GRADE_BUILT=1 nothing is built; with
# DELISO_GRADE_ABORT=1 the first wrong line ends a program.
# Exit status 1 unless all pass. Usage: grade.sh BUILD [EXERCISE]
set -u
build=$1
only=${2:-}
course=$build/course
patience=${DELISO_GRADE_SECONDS:-60}
tab=$(printf '\t')

if [ -n "$only" ] && ! grep -q "^$only$tab" "$course/exercises"; then
  echo "grade.sh: no exercise '$only': $(cut -f 1 "$course/exercises" | paste -sd' ' -)" >&2
  exit 2
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
report=$work/report
# limited ARGUMENT...: the program of the exercise, within its bounds. 124 and 137: it was stopped.
limited() (
  ulimit -t 10
  timeout -k 1 "$patience" "$course/course_$name" "$@" </dev/null 3<&-
)
unsolved=0
printf '%-20s %-14s %s\n' exercise 'cases passed' seconds
while IFS=$tab read -r name cases <&3; do
  [ -z "$only" ] || [ "$name" = "$only" ] || continue
  log=$course/$name.log
  seconds=
  solved=false
  if [ -n "${DELISO_GRADE_BUILT:-}" ] || cmake --build "$build" --target "course_$name" >"$log" 2>&1 </dev/null; then
    : >"$report"
    limited "-tc=$cases" --count "-o=$report" >/dev/null 2>&1
    count=$(sed -n 's/.* filters: *//p' "$report")
    : >"$report"
    status=0
    (
      limited "-tc=$cases" "-o=$report" ${DELISO_GRADE_ABORT:+-aa=1} >"$log" 2>&1
      status=$?
      times >"$work/times"
      exit "$status"
    ) 2>/dev/null || status=$?
    cat "$report" >>"$log"
    seconds=$(sed -n '2s/^0m\([0-9]*\.[0-9]\).*/\1/p' "$work/times")
    passed=$(sed -n 's/.*test cases: *[0-9]* | *\([0-9]*\) passed.*/\1/p' "$report")
    outcome="${passed:-0} of ${count:=0}"
    if [ "$status" -eq 0 ] && [ "$count" -gt 0 ] && [ "$passed" = "$count" ]; then solved=true; fi
    [ "$status" -ne 137 ] || outcome='over 10 s'  # killed
    [ "$status" -ne 124 ] || outcome="waits $patience s"
  else
    outcome='does not build'
  fi
  $solved || unsolved=$((unsolved + 1))
  printf '%-20s %-14s %s\n' "$name" "$outcome" "$seconds"
  [ -z "$only" ] || cat "$log"
done 3<"$course/exercises"
[ "$unsolved" -gt 0 ] || exit 0
[ -n "$only" ] || echo 'make grade EXERCISE=NAME shows what is wrong'
exit 1

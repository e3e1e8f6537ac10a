#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the tables and the studies and writes OUT/results.md and OUT/figures/*.svg. Measurements run
# one after the other; what only counts runs two at a time after them. What stands in
# OUT/results-notes.md under a program's name goes below that program's tables. Nothing is written
# unless all of it succeeded.
# Usage: write_results.sh BUILD OUT [DATA]      BUDGET: seconds per figure at most (default 5; half in the studies)
set -eu
[ $# -ge 2 ] || { echo "usage: $0 BUILD OUT [DATA]" >&2; exit 2; }
build=$1
out=$2
data=${3:-}
budget=${BUDGET:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
mkdir -p "$work/figures" "$out/figures"

run() {
  echo "$1" >&2
  started=$(date +%s)
  limit=$budget
  case $1 in study_*) limit=$(awk "BEGIN { print $budget / 2 }") ;; esac
  "$build/bench/$1" --markdown --budget "$limit" --figures "$work/figures" \
    ${data:+--data "$data"} >"$work/$1.md" || return 1
  echo "| $1 | $(($(date +%s) - started)) |" >"$work/$1.time"
}
programs='table1_datasets table2_speedup table3_insertion table4_cpi
  study_scaling study_switch study_counts
  study_oversampled'
for program in table2_speedup table3_insertion study_scaling study_switch; do
  run $program
done
run study_oversampled &
counting=$!
run study_counts
run table1_datasets
run table4_cpi
wait $counting

title_of() {
  case $1 in
    table1_datasets) echo 'Table 1: the data sets' ;;
    table2_speedup) echo 'Table 2: one stage against two' ;;
    table3_insertion) echo 'Table 3: insertions, and the vertices of the mesh' ;;
    table4_cpi) echo 'Table 4: computations per search' ;;
    study_scaling) echo 'Time against the size of the output' ;;
    study_switch) echo 'How early can one switch?' ;;
    study_counts) echo "Which reading gives the paper's counts?" ;;
    study_oversampled) echo 'The topology, counted from outside' ;;
  esac
}
figures_of() {
  case $1 in
    study_scaling) echo 'scaling-resolution scaling-epsilon' ;;
    study_switch) echo 'switch-time switch-points' ;;
  esac
}
# The paragraphs under "## PROGRAM" in the notes.
notes_of() {
  [ -e "$out/results-notes.md" ] || return 0
  awk -v wanted="## $1" '/^## / { inside = $0 == wanted; next } inside' "$out/results-notes.md"
}
# Linux says it in /proc; macOS in sysctl.
processor() {
  sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1 | grep . ||
    sysctl -n machdep.cpu.brand_string 2>/dev/null || uname -m
}
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
kind=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$build/CMakeCache.txt")
{
  echo '# Results'
  echo
  echo "The paper's evaluation, its figures beside ours, and some questions past it. Made by"
  echo "\`make tables DATA=folder\` on $(date -u +%Y-%m-%d): $(processor | tr -s ' '), one thread,"
  echo "$("$compiler" --version | head -n 1), $kind. The text between the tables is written by hand"
  echo '([results-notes.md](results-notes.md)); the tables and plots are not.'
  for program in $programs; do
    printf '\n## %s\n\n' "$(title_of "$program")"
    cat "$work/$program.md"
    for figure in $(figures_of "$program"); do
      printf '![%s](figures/%s.svg)\n' "$figure" "$figure"
    done
    notes_of "$program"
  done
  printf '\n## How long this took\n\n| program | seconds |\n| --- | ---: |\n'
  for program in $programs; do cat "$work/$program.time"; done
} >"$work/results.md"
cp "$work"/figures/*.svg "$out/figures/"
mv "$work/results.md" "$out/results.md"
echo "$out/results.md" >&2

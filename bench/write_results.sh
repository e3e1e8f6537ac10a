#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the tables and the studies, and puts their numbers into the tables of OUT/results.md and the
# plots into OUT/figures. A table stands there under the title that a program prints; the page says
# which of its columns and rows it has (put_tables.awk). All else on the page is written by hand.
# Nothing is written unless all of it succeeded.
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
  limit=$budget
  case $1 in study_*) limit=$(awk "BEGIN { print $budget / 2 }") ;; esac
  "$build/bench/$1" --markdown --budget "$limit" --figures "$work/figures" \
    ${data:+--data "$data"} >"$work/$1.md"
}
for program in table2_speedup table3_insertion study_scaling study_switch \
    study_counts table1_datasets table4_cpi table5_restricted; do
  run $program
done

# Linux says it in /proc; macOS in sysctl.
processor() {
  sed -n 's/^model name[^:]*: *//p' /proc/cpuinfo 2>/dev/null | head -n 1 | grep . ||
    sysctl -n machdep.cpu.brand_string 2>/dev/null || uname -m
}
compiler=$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$build/CMakeCache.txt")
kind=$(sed -n 's/^CMAKE_BUILD_TYPE:[A-Z]*=//p' "$build/CMakeCache.txt")
measured="Measured on $(date -u +%Y-%m-%d): $(processor | tr -s ' '), one thread, $("$compiler" --version |
  head -n 1), $kind"
awk -v measured="$measured" -f "$(dirname "$0")/put_tables.awk" "$out/results.md" "$work"/*.md >"$work/results"
cp "$work"/figures/*.svg "$out/figures/"
mv "$work/results" "$out/results.md"
echo "$out/results.md" >&2

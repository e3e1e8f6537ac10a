#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds TARGET and runs tests. Tells the ten slowest, and the seconds of both.
# Usage: run_tests.sh BUILD JOBS TARGET [options of ctest]
set -eu
build=$1
jobs=$2
target=$3
shift 3
started=$(date +%s)
cmake --build "$build" -j "$jobs" --target "$target"
built=$(date +%s)
status=0
ctest --test-dir "$build" --output-on-failure -j "$jobs" "$@" || status=$?
ended=$(date +%s)
echo 'the slowest:'
awk '/ Testing: / { name = $3 } /^Test time =/ { print $4 " s  " name }' "$build/Testing/Temporary/LastTest.log" |
  sort -rn | head -n 10
echo "compiled in $((built - started)) s, run in $((ended - built)) s"
exit "$status"

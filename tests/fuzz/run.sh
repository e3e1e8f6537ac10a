#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs the fuzz targets one after the other, each for FUZZ_SECONDS (60), on a corpus that is kept
# between runs. It goes on after a finding, and exits 1 when there was one. A line per target and run
# is added to CORPUS/runs.tsv: target, executed inputs, processor seconds, inputs kept, findings.
# Usage: run.sh BUILD_FOLDER CORPUS_FOLDER [TARGET...]
set -eu
build=$1
corpus=$2
shift 2
seconds=${FUZZ_SECONDS:-60}
mkdir -p "$corpus/findings" "$corpus/tmp"
"$build/make_corpus" "$corpus/seeds"

# Sets `spent` to the processor seconds of all children so far (a subshell would have its own).
measure() {
  times >"$corpus/times"
  spent=$(awk 'NR == 2 { gsub(/[ms]/, " "); print 60 * $1 + $2 + 60 * $3 + $4 }' "$corpus/times")
}

# shellcheck disable=SC2046
[ $# -gt 0 ] || set -- $(cd "$build" && echo fuzz_* | sed 's/fuzz_//g')
findings=0
for target in "$@"; do
  mkdir -p "$corpus/$target" "$corpus/seeds/$target"
  log=$corpus/$target.log
  # Limits: no single allocation of more than 256 MB, for inputs of 8 kB at most.
  case $target in
    pipeline) longest=700 timeout=60 ;;
    part) longest=64 timeout=20 ;; # of a few edits
    *) longest=8192 timeout=10 ;;
  esac
  measure
  before=$spent
  status=0
  TMPDIR=$corpus/tmp "$build/fuzz_$target" -max_total_time="$seconds" -max_len=$longest \
    -timeout=$timeout -malloc_limit_mb=256 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$corpus/findings/$target-" "$corpus/$target" "$corpus/seeds/$target" \
    >"$log" 2>&1 || status=$?
  units=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  measure
  used=$(echo "$spent $before" | awk '{ printf "%.0f", $1 - $2 }')
  kept=$(find "$corpus/$target" -type f | wc -l)
  echo "$target ${units:-0} $used $kept $status" | tr ' ' '\t' >>"$corpus/runs.tsv"
  echo "$target: ${units:-0} inputs in $used s of processor time, $kept kept"
  if [ "$status" -ne 0 ]; then
    findings=$((findings + 1))
    grep -a -m 1 -E '^found:|ERROR:|runtime error|internal error' "$log" || :
    echo "  a finding: $log, $corpus/findings"
  fi
done
rm -rf "$corpus/tmp" "$corpus/times"
[ "$findings" -eq 0 ]

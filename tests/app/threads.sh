#!/bin/sh
# SPDX-License-Identifier: MIT
# Meshes, reports and pictures are the same bytes with any number of threads. Usage: threads.sh
# PROGRAM
set -eu
deliso=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

# What a report says but for times, memory and the number of threads.
timeless() {
  sed '/"seconds": {/,/}/d' "$1" | grep -v -e '"threads"' -e '"peak_memory_bytes"'
}

# same NAME COMMAND...: runs it with one thread and with others, and compares what it leaves behind.
same() {
  name=$1
  shift
  for threads in 1 2 3 8; do
    mkdir -p "$threads"
    status=0
    (cd "$threads" && "$deliso" "$@" --threads "$threads" -o "$name.ply" --json "$name.json" -q) ||
      status=$?
    echo "exit $status" >>"$threads/$name.json"
    timeless "$threads/$name.json" >"$threads/$name.txt"
    cmp "1/$name.ply" "$threads/$name.ply"
    cmp "1/$name.txt" "$threads/$name.txt"
  done
  echo "$name: $(wc -c <"1/$name.ply") bytes"
}

same gyroid builtin:gyroid:88 --check
same closed builtin:gyroid:64 --rmin 0.2vox --cap
same noise builtin:noise:24 --check --max-distance 0.05vox
same machine builtin:machine:128 --ply-ascii
same small builtin:noise:32 --min-component 6
same paper builtin:torus:32 --paper --eps1 0.2
same capped builtin:machine:48 --cap
same filtered builtin:noise:24 --median 1 --smooth 0.8vox --check
same counted builtin:gyroid:48 --vertices 5000

for threads in 1 2 3 8; do
  "$deliso" check 1/gyroid.ply builtin:gyroid:88 --iso 0 --threads "$threads" \
    --json "$threads/check.json" -q || true
  timeless "$threads/check.json" >"$threads/check.txt"
  cmp 1/check.txt "$threads/check.txt"
done

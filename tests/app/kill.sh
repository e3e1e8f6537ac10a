#!/bin/sh
# SPDX-License-Identifier: MIT
# kill -9 at random moments while a mesh is made and written: the target is never damaged. It is
# absent, or holds its old bytes, or is complete. A temporary file may be left beside it: between
# its getting a name and the target's, or at any time where the file system gives all files names.
# Usage: kill.sh PROGRAM [KILLS [SEED]]     (20 kills, seed 1)
set -eu
deliso=$1
kills=${2:-20}
seed=${3:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir out

# The whole mesh, and how long it takes.
mesh="builtin:gyroid:48 -q --ply-ascii --rmin 0.2vox --max-distance 0.03vox"
start=$(date +%s%N)
# shellcheck disable=SC2086
"$deliso" $mesh -o whole.ply
microseconds=$((($(date +%s%N) - start) / 1000))
echo old >old.ply

faults=0
fault() {
  echo "FAULT: kill $n: $*"
  faults=$((faults + 1))
}
complete=0 killed=0 left=0 writing=0
n=0
while [ "$n" -lt "$kills" ]; do
  n=$((n + 1))
  # A moment of its whole time and a little more. Park and Miller's generator.
  seed=$((seed * 48271 % 2147483647))
  delay=$((seed % (microseconds * 11 / 10)))
  target=out/mesh.ply
  rm -f "$target"
  [ $((n % 4)) -lt 2 ] || cp old.ply "$target"

  # shellcheck disable=SC2086
  "$deliso" $mesh -o "$target" &
  process=$!
  if [ $((n % 2)) -eq 0 ] && [ -d /proc/self/fd ]; then
    # Every other one while the file is written: it is the only one that the program opens.
    while kill -0 $process 2>/dev/null && [ ! -e /proc/$process/fd/3 ]; do :; done
    [ ! -e /proc/$process/fd/3 ] || writing=$((writing + 1))
    turns=$((delay % 3000))
    while [ $turns -gt 0 ]; do turns=$((turns - 1)); done
  else
    sleep "$(printf '%d.%06d' $((delay / 1000000)) $((delay % 1000000)))"
  fi
  kill -9 $process 2>/dev/null || :
  status=0
  wait $process 2>/dev/null || status=$?
  [ "$status" -eq 0 ] || killed=$((killed + 1))

  if [ -e "$target" ]; then
    if cmp -s "$target" whole.ply; then
      complete=$((complete + 1))
    elif [ $((n % 4)) -lt 2 ]; then
      fault "a partial file of $(wc -c <"$target") bytes"
    elif ! cmp -s "$target" old.ply; then
      fault "the old file is gone and the new one not complete"
    fi
  elif [ $((n % 4)) -ge 2 ]; then
    fault "the old file is gone"
  fi
done
for file in out/.deliso-*.tmp; do
  [ ! -e "$file" ] || left=$((left + 1))
done

# The next run is not hindered by what is there.
# shellcheck disable=SC2086
"$deliso" $mesh -o out/mesh.ply
cmp -s out/mesh.ply whole.ply || fault "no complete file afterwards"

echo "$kills kills: $killed hit a running program, $writing while it wrote, $complete complete" \
  "files, $left temporary files left, $faults faults"
[ "$killed" -gt 0 ] && [ "$faults" -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# A storm shows a seed, as docs/guide/a-seed-failed.md says: with DELISO_SEE it writes the meshes, and
# the commands that it prints run. Without it nothing is written. The seed has a needle: no seed is
# known with a fault, of which there would be a mesh and a picture, too.
# Usage: see.sh STRESS_OPTIONS DELISO
set -eu
storm=$1
deliso=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
seed=41

"$storm" --first-seed $seed --count 1 --list >said
[ "$(ls)" = said ] || { echo "FAULT: written without DELISO_SEE: $(ls)"; exit 1; }
DELISO_SEE=seen "$storm" --first-seed $seed --count 1 --list >said
for kind in mesh contour without; do
  [ -s "seen/stress_options-$seed-$kind.ply" ] || { echo "FAULT: no $kind in $(ls seen)"; exit 1; }
done
sed -n 's/^  deliso //p' said >commands
[ "$(wc -l <commands)" -eq 3 ] || { echo 'FAULT: not three commands:' && cat said && exit 1; }
while read -r command; do
  # shellcheck disable=SC2086
  "$deliso" $command
done <commands
for made in -contour.html -without.html; do
  [ -s "seen/stress_options-$seed$made" ] || { echo "FAULT: no $made"; exit 1; }
done

#!/bin/sh
# SPDX-License-Identifier: MIT
# A storm shows a seed with a fault, as docs/guide/a-seed-failed.md says: with DELISO_SEE it writes the
# meshes, and the commands that it prints run. Without it nothing is written. The seed is one of
# known_failures.h. Usage: see.sh STRESS_OPTIONS DELISO
set -eu
storm=$1
deliso=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
seed=7387

"$storm" --first-seed $seed --count 1 --list >said
[ "$(ls)" = said ] || { echo "FAULT: written without DELISO_SEE: $(ls)"; exit 1; }
DELISO_SEE=seen "$storm" --first-seed $seed --count 1 --list >said
for kind in mesh fault contour without; do
  [ -s "seen/stress_options-$seed-$kind.ply" ] || { echo "FAULT: no $kind in $(ls seen)"; exit 1; }
done
sed -n 's/^  deliso //p' said >commands
[ "$(wc -l <commands)" -eq 4 ] || { echo 'FAULT: not four commands:' && cat said && exit 1; }
while read -r command; do
  case $command in render*) command="$command --size 320x240" ;; esac
  # The command of the mesh tells of the fault, by the exit status 1.
  # shellcheck disable=SC2086
  "$deliso" $command || [ $? -eq 1 ]
done <commands
for made in -contour.html -without.html .png; do
  [ -s "seen/stress_options-$seed$made" ] || { echo "FAULT: no $made"; exit 1; }
done

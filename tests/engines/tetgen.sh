#!/bin/sh
# SPDX-License-Identifier: MIT
# TetGen fills the solids that --cap makes of scans: a surface that does not cross itself is not
# enough, it must keep apart. Volumes are in the folder DELISO_DATA. Exit status 77 without TetGen;
# runs of volumes that are not there are left out with a word. Usage: tetgen.sh SOURCE DELISO
set -eu
source=$(realpath "$1")
deliso=$(realpath "$2")
. "$source/tests/holds.sh"
command -v tetgen >/dev/null || { echo "no tetgen here: it was not tried"; exit 77; }
data=${DELISO_DATA:-$source/datasets}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

fills() {
  "$deliso" "$@" --cap -o "$work/solid.smesh" >"$work/report" 2>&1 || { cat "$work/report"; return 1; }
  tetgen -p "$work/solid.smesh" >"$work/tetgen.log" 2>&1 || { tail -n 5 "$work/tetgen.log"; return 1; }
  awk '/Mesh tetrahedra:/ { n = $3 } END { print "  " n " tetrahedra"; exit n < 1000 }' "$work/tetgen.log"
}

runs=0
while read -r volume options; do
  case $volume in
    builtin:*) input=$volume ;;
    *) input=$data/$volume.nhdr ;;
  esac
  if [ "$input" != "$volume" ] && [ ! -e "$input" ]; then
    echo "no $input: not tried"
    continue
  fi
  runs=$((runs + 1))
  # shellcheck disable=SC2086
  holds "TetGen fills $volume $options" fills "$input" $options
done <<END
leg --iso 54.6 --smooth 0.7vox --largest 1
leg --iso 119.5 --largest 1
leg --iso 120 --largest 1
leg --iso 119.5 --smooth 1vox
leg --iso 119.5 --vertices 20000
leg --iso 119.5 --min-component 20
baby --iso 131.6
tooth --iso 146.9
engine --iso 40.1
aneurism --iso 124.6
builtin:noise:32
END
all_hold "$runs"

#!/bin/sh
# SPDX-License-Identifier: MIT
# Meshes and counts are the same bytes on every processor. The GNU C library has variants of sin, exp
# and others for processors with fused multiply-add, which differ in their last bits. Its tunables
# switch them off: this processor then stands for another. A second program, of another compiler,
# must give the same bytes too. Usage: same_bytes.sh PROGRAM [SECOND_PROGRAM]
set -eu
. "$(dirname "$0")/../holds.sh"
deliso=$(realpath "$1")
second=${2:+$(realpath "$2")}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
mkdir plain without_fma second

without_fma() {
  GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-AVX2 "$@"
}
# The numbers of a report that count something.
counts() {
  sed '/"seconds": {/,/}/d' "$1" | grep -E '": [0-9]+,?$' |
    grep -v -e '"threads"' -e '"peak_memory_bytes"'
}
# run FOLDER COMMAND...: makes mesh and report there. The exit status is part of the outcome.
run() {
  folder=$1
  shift
  rm -f $folder/*
  status=0
  "$@" -q -o $folder/mesh.ply --json $folder/json || status=$?
  echo "exit $status" >$folder/counts
  counts $folder/json >>$folder/counts
}
# same OPTIONS...: the mesh and its report are the same both ways, and of both programs.
same() {
  run plain "$deliso" "$@" &
  [ -z "$second" ] || run second "$second" "$@" &
  run without_fma without_fma "$deliso" "$@"
  wait
  holds "$*: the same mesh without FMA" cmp plain/mesh.ply without_fma/mesh.ply
  holds "$*: the same counts without FMA" cmp plain/counts without_fma/counts
  [ -n "$second" ] || return 0
  holds "$*: the same mesh of both programs" cmp plain/mesh.ply second/mesh.ply
  holds "$*: the same counts of both programs" cmp plain/counts second/counts
}

for field in sphere torus linked_tori five_spheres orbital fuel marschner_lobb machine noise; do
  same builtin:$field:24
done
# Long voxels are all split into cells. There g++ 12 once took the wrong ones for unlike
# (contour/voxel_topology.h); another compiler tells.
same builtin:noise:16 --spacing 1,1,4
same builtin:noise:16 --spacing 4,1,1
# Solids.
for field in fuel noise; do
  "$deliso" builtin:$field:16 --cap -q -o skin.ply
  same solid skin.ply --format mesh
done
# With an odd number of samples the sum of sines is 0 at some of them, but for rounding.
for size in 24 41 81; do same builtin:gyroid:$size --max-distance 0.3vox; done

# Samples in double precision show every bit of a filter. The last three Gaussians have weights that
# the variants of exp round differently.
awk 'BEGIN {
  print "# vtk DataFile Version 3.0\nwaves\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 20 20 20"
  print "ORIGIN 0 0 0\nSPACING 1 1 1\nPOINT_DATA 8000\nSCALARS f double 1\nLOOKUP_TABLE default"
  for (n = 0; n < 8000; ++n) print n % 20 / 10 - 1 + (n * n * 37 + n * 101) % 1009 / 1009 - 0.5
}' >doubles.vtk
for sigma in 0.7 5.53 5.79 5.97; do same doubles.vtk --iso 0 --smooth $sigma; done

same builtin:noise:24 --smooth 1
same builtin:noise:24 --median 1
same builtin:noise:24 --median 1 --smooth 0.7vox --check
same builtin:machine:32 --label 255
same builtin:noise:16 --paper --rmin 0.5vox --max-vertices 20000
same builtin:gyroid:16 --paper
same builtin:fuel:24 --paper --solver isolation --check
same builtin:torus:16 --paper --facet-cycles
same builtin:gyroid:32 --vertices 2000
same builtin:gyroid:32 --cap
same builtin:noise:16 --cap --check

all_hold 50

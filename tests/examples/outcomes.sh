#!/bin/sh
# SPDX-License-Identifier: MIT
# Whether what the examples have made is true: by the program, by known constants, by one another.
# Usage: outcomes.sh FOLDER PROGRAM; FOLDER is where the page of the examples was run.
set -eu
# shellcheck source=tests/holds.sh
. "$(dirname "$0")/../holds.sh"
cd "$1"
deliso=$2

# between LOW VALUE HIGH
between() { awk "BEGIN { exit !($1 <= $2 && $2 <= $3) }"; }
# The criteria in the comments are the program's alone.
same() {
  grep -av '^comment' "$1" >a
  grep -av '^comment' "$2" | cmp - a
}

"$deliso" builtin:fuel --iso 70.1 --max-distance 0.25vox -q -o expected.ply
holds 'mesh_file makes the mesh of the program' same expected.ply fuel.ply
holds 'it passes' "$deliso" check fuel.ply builtin:fuel --iso 70.1 -q

out/mesh_function | awk '{ print $NF }' | paste -s >errors
read -r coarse middle fine <errors
holds 'a quarter of the error is left' between 3.8 "$coarse / $middle" 4.2
holds 'and again' between 3.8 "$middle / $fine" 4.2
# 2 pi^2 R r^2
holds 'the rest of the volume is there' between 0.7401 "$(
  out/largest_piece torus.ply torus.off | sed -n 's/.*volume //p') + $fine" 0.7403

out/delaunay_points >points
holds 'neighbors of a point: 2 + 48 pi^2 / 35' \
  between 15.45 "$(sed -n 's/neighbors of a point: //p' points)" 15.62
holds 'nothing is nearer to the loneliest place than its four points' between -1e-12 "$(
  sed -n 's/.*, \([0-9.e-]*\) from four points, the nearest of all at \(.*\)/\1 - \2/p' points)" 1e-12
out/delaunay_points 4000 >fewer
# The largest empty ball goes with the cube root of the points' mean distance.
holds 'fewer points are lonelier' between 1.3 "$(
  sed -n 's/.*), \([^ ]*\) from.*/\1/p' fewer) / $(sed -n 's/.*), \([^ ]*\) from.*/\1/p' points)" 2.2

out/largest_piece fuel.ply piece.ply >whole
out/largest_piece piece.ply again.off >piece
holds 'one component is left' [ "$(grep -c '^component' piece)" -eq 1 ]
holds 'the first, as it was' [ "$(grep 'largest' piece)" = "$(grep 'largest' whole)" ]
holds 'it was the largest' [ "$(grep '^component' piece)" = "$(
  grep '^component' whole | sort -k 2 -n -r | head -n 1)" ]

out/ray_in_voxel >ray
holds 'three points by either solver' [ "$(grep -c ', where the interpolant is 0.5$' ray)" -eq 6 ]
holds 'the same' [ "$(grep 't =' ray | sort -u | wc -l)" -eq 3 ]

out/watch_run >events
# Each triangle that an event took out was there, and what is left is the mesh.
holds 'triangles come and go until they are the mesh' \
  [ "$(sed -n 's/.*add up to \([0-9]*\), .*/\1/p' events)" = "$(
    sed -n 's/.*the mesh has //p' events)" ]
"$deliso" builtin:fuel:32 --iso 70.1 -q --json report.json -o whole.ply
inserted=$(awk '/^Stage 2/ { n += $NF } END { print n }' events)
holds 'Stage 2 inserts as many vertices as the report says' \
  [ "$inserted" -eq "$(sed -n 's/.*"insertions_refine": *\([0-9]*\).*/\1/p' report.json)" ]
all_hold 15

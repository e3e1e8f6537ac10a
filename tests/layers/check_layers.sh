#!/bin/sh
# SPDX-License-Identifier: MIT
# A room of the seven trees includes only itself, what is named here for it, and what that may use: a
# room, or one file of it. The rooms of src/ go by their names alone, as in includes. So src/, what
# makes a mesh, includes nothing of the others: more/ is what is made of a mesh, check/ trusts no
# stage. Usage: check_layers.sh PROJECT
set -eu
cd "$1"

surface="base exact mesh embedding volume roots isosurface run surface"
stages="$surface contour coarsen refine"
all="$stages blocks more/bodies more/cap more/counts more/solids"
io="io/files io/volume io/filter io/mesh io/solid io/parts"
view="view/gray view/page view/render view/trace"

allowed() {
  case $1 in
    base) echo base ;;
    roots | exact | mesh | volume) echo "base $1" ;;
    delaunay) echo "base exact delaunay" ;;
    isosurface) echo "base roots volume isosurface" ;;
    kdtree) echo "base volume isosurface/lattice_line.h kdtree" ;;
    embedding) echo "base exact mesh embedding" ;;
    contour) echo "base volume exact mesh embedding contour" ;;
    run) echo "base mesh volume isosurface run" ;;
    surface) echo "$surface contour/boundary_loop.h contour/sheet_walk.h" ;;
    coarsen) echo "$surface contour coarsen" ;;
    recover) echo "base roots volume kdtree isosurface exact delaunay mesh embedding contour paper recover" ;;
    refine) echo "$surface refine" ;;
    deliso) echo "$all recover deliso" ;;
    # As published: the primitives alone. Of src/ only recover includes it.
    paper) echo "base roots volume kdtree isosurface exact delaunay mesh paper" ;;
    blocks) echo "$surface contour coarsen refine blocks" ;;
    more/planar) echo "base exact more/planar" ;;
    more/cap) echo "$surface delaunay/hilbert.h contour refine more/planar more/cap" ;;
    more/counts) echo "$surface contour coarsen refine blocks more/counts" ;;
    more/bodies) echo "$surface coarsen refine more/bodies" ;;
    more/solids) echo "base exact delaunay more/solids" ;;
    check) echo "base roots exact delaunay mesh embedding volume contour isosurface" \
      "run/criteria.h more/solids/solid.h check" ;;
    io/files) echo "base io/files" ;;
    io/volume) echo "base volume io/files io/volume" ;;
    io/filter) echo "base volume io/files io/filter" ;;
    io/mesh) echo "base mesh embedding/box_grid.h io/files io/mesh" ;;
    io/solid) echo "base more/solids/solid.h io/files io/solid" ;;
    io/parts) echo "base volume mesh blocks/block.h blocks/grid.h check/check_mesh.h $io" ;;
    view/page) echo "base io/files view/page" ;;
    view/render) echo "base mesh io/files view/render" ;;
    view/gray) echo "base volume io/files mesh view/render view/gray" ;;
    view/trace) echo "$surface delaunay contour paper recover refine view/trace" ;;
    app) echo "deliso $all delaunay kdtree paper recover check $io $view app" ;;
    c) echo "deliso $all paper recover check $io $view app c" ;;
    *) return 1 ;;
  esac
}

files=0
faults=0
for file in $(find src more deliso check io view app c -name '*.h' -o -name '*.cpp'); do
  files=$((files + 1))
  room=${file%/*}
  room=${room#src/}
  if ! may_use=$(allowed "$room"); then
    echo "$file: room '$room' has no place in the layers"
    faults=$((faults + 1))
    continue
  fi
  # No stage has threads: blocks have.
  case $room in
    base | blocks | check | more/bodies | io/filter | view/* | app | c) threads=yes ;;
    *) threads= ;;
  esac
  for included in $(sed -n 's|^ *# *include *"\([^"]*\)".*|\1|p' "$file"); do
    if [ "$included" = base/parallel.h ] && [ -z "$threads" ]; then
      echo "$file: '$room' may not divide work among threads"
      faults=$((faults + 1))
    fi
    case " $may_use " in
      *" ${included%/*} "* | *" $included "*) ;;
      *)
        echo "$file: '$room' may not include \"$included\""
        faults=$((faults + 1))
        ;;
    esac
  done
done

echo "$files files, $faults faults"
[ "$files" -ge 20 ] && [ "$faults" -eq 0 ]

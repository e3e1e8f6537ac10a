#!/bin/sh
# SPDX-License-Identifier: MIT
# A room of the five trees includes only itself, what is named here for it, and what that may use: a
# room, or one file of it. The rooms of src/ go by their names alone, as in includes; so src/ knows
# nothing of io/, view/ and app/. src/ itself holds mesh_isosurface() and mesh_part(). Usage: check_layers.sh PROJECT
set -eu
cd "$1"

surface="base mesh embedding volume isosurface surface"
stages="$surface roots delaunay planar kdtree contour coarsen refine"
all="$stages deliso blocks cap interfaces recover"
io="io/files io/volume io/filter io/mesh io/parts"
view="view/gray view/page view/render view/trace"

allowed() {
  case $1 in
    base) echo base ;;
    roots | delaunay | mesh | volume) echo "base $1" ;;
    planar) echo "base delaunay planar" ;;
    kdtree) echo "base volume kdtree" ;;
    embedding) echo "base delaunay mesh embedding" ;;
    contour) echo "base volume delaunay mesh embedding contour" ;;
    isosurface) echo "base roots volume kdtree isosurface" ;;
    surface) echo "base mesh embedding volume isosurface contour/boundary_loop.h surface" ;;
    coarsen) echo "$surface delaunay contour coarsen" ;;
    recover) echo "base roots volume kdtree isosurface delaunay mesh embedding contour paper recover" ;;
    refine) echo "$surface refine" ;;
    deliso) echo "$stages deliso" ;;
    # As published: the primitives alone. Of src/ only recover includes it.
    paper) echo "base roots volume kdtree isosurface delaunay mesh paper" ;;
    blocks) echo "$surface contour coarsen refine deliso blocks" ;;
    cap) echo "$surface delaunay planar contour refine/refinement.h refine/lift_off.h cap" ;;
    interfaces) echo "base delaunay mesh embedding volume interfaces" ;;
    .) echo "mesh_parts.h $all" ;;
    check) echo "base roots delaunay mesh embedding volume kdtree contour isosurface" \
      "surface/criteria.h check" ;;
    io/files) echo "base io/files" ;;
    io/volume) echo "base volume io/files io/volume" ;;
    io/filter) echo "base volume io/files io/filter" ;;
    io/mesh) echo "base mesh io/files io/mesh" ;;
    io/parts) echo "base volume mesh blocks/block.h blocks/grid.h $io" ;;
    view/page) echo "base io/files view/page" ;;
    view/render) echo "base mesh io/files view/render" ;;
    view/gray) echo "base volume io/files mesh view/render view/gray" ;;
    view/trace) echo "$surface delaunay contour paper recover refine view/trace" ;;
    app) echo "mesh_parts.h $all paper check $io $view app" ;;
    c) echo "mesh_parts.h $all paper check $io $view app c" ;;
    *) return 1 ;;
  esac
}

files=0
faults=0
for file in $(find src io view app c -name '*.h' -o -name '*.cpp'); do
  files=$((files + 1))
  room=${file%/*}
  room=${room#src/}
  [ "$room" != src ] || room=.
  if ! may_use=$(allowed "$room"); then
    echo "$file: room '$room' has no place in the layers"
    faults=$((faults + 1))
    continue
  fi
  # No stage has threads: blocks have.
  case $room in
    base | blocks | check | io/filter | view/* | app | c) threads=yes ;;
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

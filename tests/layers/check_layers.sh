#!/bin/sh
# SPDX-License-Identifier: MIT
# A folder of src/ includes only itself, what is named here for it, and what that may use: a folder,
# or one file of it. Usage: check_layers.sh SRC
set -eu
src=$1

allowed() {
  case $1 in
    base) echo base ;;
    roots | delaunay | files) echo "base $1" ;;
    mesh | volume) echo "base files $1" ;;
    blocks) echo "base files mesh volume blocks" ;;
    planar) echo "base delaunay planar" ;;
    render) echo "base files mesh render" ;;
    page) echo "base files page" ;;
    kdtree | contour) echo "base volume $1" ;;
    embedding) echo "base delaunay mesh embedding" ;;
    isosurface) echo "base roots volume kdtree isosurface" ;;
    trace) echo "base mesh trace" ;;
    surface) echo "base mesh embedding volume isosurface trace surface" ;;
    recover) echo "base delaunay mesh embedding volume contour isosurface trace surface recover" ;;
    refine) echo "base delaunay/predicates.h mesh embedding volume isosurface trace surface refine" ;;
    cap) echo "base delaunay planar mesh embedding volume isosurface surface refine/replace_disk.h cap" ;;
    baseline) echo "base mesh volume contour baseline" ;;
    deliso) echo "base roots delaunay planar mesh embedding volume kdtree contour isosurface trace surface" \
      "recover refine cap baseline deliso" ;;
    check) echo "base roots delaunay mesh embedding volume kdtree contour isosurface" \
      "surface/criteria.h check" ;;
    app) echo "base files roots delaunay planar mesh embedding volume kdtree contour isosurface trace surface" \
      "recover refine cap baseline deliso check render page blocks app" ;;
    *) return 1 ;;
  esac
}

files=0
faults=0
for file in "$src"/*/*.h "$src"/*/*.cpp; do
  [ -f "$file" ] || continue
  files=$((files + 1))
  folder=$(basename "$(dirname "$file")")
  if ! may_use=$(allowed "$folder"); then
    echo "$file: folder '$folder' has no place in the layers"
    faults=$((faults + 1))
    continue
  fi
  for included in $(sed -n 's|^ *# *include *"\([^"]*\)".*|\1|p' "$file"); do
    case " $may_use " in
      *" ${included%%/*} "* | *" $included "*) ;;
      *)
        echo "$file: '$folder' may not include \"$included\""
        faults=$((faults + 1))
        ;;
    esac
  done
done

echo "$files files, $faults faults"
[ "$files" -ge 20 ] && [ "$faults" -eq 0 ]

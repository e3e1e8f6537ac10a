#!/bin/sh
# SPDX-License-Identifier: MIT
# A folder of src/ includes only itself, what is named here for it, and what that may use: a folder,
# or one file of it. Usage: check_layers.sh SRC
set -eu
src=$1

surface="base mesh embedding volume isosurface surface"
stages="$surface roots delaunay planar kdtree contour stage1 paper recover refine blocks trace cap baseline"

allowed() {
  case $1 in
    base) echo base ;;
    roots | delaunay | files) echo "base $1" ;;
    mesh | volume) echo "base files $1" ;;
    blocks) echo "$surface files contour refine blocks" ;;
    planar) echo "base delaunay planar" ;;
    render) echo "base files mesh render" ;;
    page) echo "base files page" ;;
    kdtree) echo "base volume kdtree" ;;
    embedding) echo "base delaunay mesh embedding" ;;
    contour) echo "base volume delaunay mesh embedding contour" ;;
    isosurface) echo "base roots volume kdtree isosurface" ;;
    surface) echo "base mesh embedding volume isosurface surface" ;;
    stage1 | paper | recover) echo "$surface delaunay contour stage1 $1" ;;
    trace) echo "$surface delaunay contour stage1 paper recover refine trace" ;;
    refine) echo "$surface refine" ;;
    cap) echo "$surface delaunay planar refine/refinement.h cap" ;;
    baseline) echo "base mesh volume contour baseline" ;;
    deliso) echo "$stages deliso" ;;
    check) echo "base roots delaunay mesh embedding volume kdtree contour isosurface" \
      "surface/criteria.h check" ;;
    app) echo "$stages files deliso check render page blocks app" ;;
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

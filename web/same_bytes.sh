#!/bin/sh
# SPDX-License-Identifier: MIT
# The program as WebAssembly writes the bytes that the native one writes. Of ten volumes: their meshes, in
# all formats, and what the other commands write of some. FOLDER may have the real volumes that the page
# docs/results.md names (engine.nhdr and so on); built-in fields stand in for those that are not there.
# The seconds of each run stand beside it. Usage: same_bytes.sh NATIVE build-web/deliso.mjs [FOLDER]
set -eu
native=$(realpath "$1")
wasm=$(realpath "$2")
data=${3:+$(realpath "$3")}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/native" "$work/wasm"
faults=0
volumes=0

# seconds_of FOLDER COMMAND...: runs it there, without its standard output. Prints the seconds; a run
# that fails ends the test.
seconds_of() {
  cd "$work/$1"
  shift
  begun=$(date +%s.%N)
  "$@" >/dev/null
  echo "$begun $(date +%s.%N)" | awk '{ printf "%.2f", $2 - $1 }'
}
# same FILE ARGUMENTS...: both programs write FILE, with the same bytes.
same() {
  file=$1
  shift
  seconds="$(seconds_of native "$native" "$@" -q) $(seconds_of wasm node "$wasm" "$@" -q)"
  verdict=same
  [ -s "$work/native/$file" ] && cmp "$work/native/$file" "$work/wasm/$file" || verdict=DIFFERENT
  [ $verdict = same ] || faults=$((faults + 1))
  printf '%-9s  %s s native, %s s wasm  %s\n' $verdict ${seconds} "$*"
}
# says ARGUMENTS...: both say the same, but for seconds and memory, and end with the same status.
says() {
  for program in native wasm; do
    cd "$work/$program"
    command=$([ $program = native ] && echo "$native" || echo "node $wasm")
    status=0
    $command "$@" >said.txt 2>&1 || status=$?
    sed -i -e '/seconds/d' -e "\$ a status $status" said.txt
  done
  if cmp "$work/native/said.txt" "$work/wasm/said.txt"; then
    echo "same       status $status: $*"
  else
    faults=$((faults + 1))
  fi
}
# mesh FILE ARGUMENTS...: the same, of the next volume.
mesh() {
  volumes=$((volumes + 1))
  same "$@"
}
# real NAME ISOVALUE FIELD: a volume of the folder, or the field.
real() {
  if [ -n "$data" ] && [ -f "$data/$1.nhdr" ]; then
    mesh "$1.ply" "$data/$1.nhdr" --iso "$2" -o "$1.ply"
  else
    mesh "$1.ply" "builtin:$3" -o "$1.ply"
  fi
}

# Three labels that meet, as text.
labels=$work/labels.nrrd
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 20 20 20\nencoding: ascii\n\n' >"$labels"
awk 'BEGIN { for (n = 0; n < 8000; ++n) { x = n % 20 - 9.5; y = int(n / 20) % 20 - 9.5; z = int(n / 400) - 9.5
  print (x * x + y * y + z * z > 60 ? 0 : x > 0 ? 1 : y > 0 ? 2 : 3) } }' >>"$labels"

real engine 40.1 machine:40
real fuel 70.1 fuel:40
real tooth 146.9 orbital:40
real baby 35.8 marschner_lobb:40
real aneurism 124.6 linked_tori:40
mesh torus.stl builtin:torus --float -o torus.stl
mesh noise.obj builtin:noise:32 --cap -o noise.obj
mesh gyroid.glb builtin:gyroid:24 --paper -o gyroid.glb
mesh spheres.vtp builtin:five_spheres --smooth 0.7vox --vertices 800 -o spheres.vtp
mesh labels.3mf "$labels" --label all --shared labels.3mf

# Memory that grows much in a short run: there Node crashed, see web/npm/deliso.mjs.
same long.ply builtin:gyroid:200 --max-distance 0.03vox -o long.ply
same view.html view torus.stl -o view.html
same render.png render torus.stl -o render.png
same slices.png info builtin:fuel --iso 70.1 -o slices.png


# Errors go the way of exceptions. Some are caught on it, and get the name of the file that named the other.
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: gzip\n\nno gzip' >"$work/damaged.nrrd"
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: raw\ndata file: none.raw\n' >"$work/none.nhdr"
says check torus.stl builtin:torus
says missing.nrrd --iso 1
says info "$work/damaged.nrrd"
says info "$work/none.nhdr"
says info "$work"
says builtin:torus --iso 7
says builtin:torus --isovalue 0 -o "$work/none/torus.ply"
says builtin:torus --threads 2 -q -o torus.off

echo "$volumes volumes, $faults files that differ"
[ "$volumes" -eq 10 ] && [ "$faults" -eq 0 ]

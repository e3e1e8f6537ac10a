#!/bin/sh
# SPDX-License-Identifier: MIT
# What the program gives when all is well: files, standard output, exit status, the same bytes every
# time. Usage: results.sh PROGRAM
set -eu
. "$(dirname "$0")/../holds.sh"
deliso=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

empty() {
  for file in "$@"; do [ ! -s "$file" ] || return 1; done
}
differ() {
  ! cmp -s "$1" "$2"
}

# Every format, by ending and on standard output, without a word on either stream when quiet.
for format in ply off obj stl vtp glb 3mf smesh poly; do
  "$deliso" builtin:sphere -q -o mesh.$format >stdout 2>stderr
  holds "-q is quiet with $format" empty stdout stderr
  "$deliso" mesh builtin:sphere -o - --format $format >piped 2>stderr
  holds "standard output gets the bytes of the $format file" cmp -s mesh.$format piped
  holds "then the report is on standard error" [ -s stderr ]
done
# The same bytes on a second run, whatever the report or the terminal. threads.sh has the threads.
"$deliso" builtin:fuel -q -o first.ply
NO_COLOR=1 "$deliso" builtin:fuel -o second.ply --json second.json >stdout
holds "two runs give the same bytes" cmp -s first.ply second.ply

# The report is on standard output, with the counts that the file has.
"$deliso" builtin:fuel -o mesh.ply >report 2>stderr
holds "nothing on a standard error that is no terminal" empty stderr
vertices=$(sed -n 's/^element vertex //p;/^end_header/q' mesh.ply)
tr -d , <report >digits
holds "the report has the file's vertices" grep -q "^mesh *$vertices vertices " digits
"$deliso" builtin:fuel -o mesh.ply --json - >json 2>stderr
holds "the JSON has the file's vertices" grep -q "\"vertices\": $vertices,\$" json

# By the number of vertices: the report has how far the surface is, and a check takes it for no limit.
"$deliso" builtin:fuel --vertices 500 -o count.off >report
holds "--vertices tells how far the surface is" \
  grep -q '^distance  the surface lies within [0-9.e-]* voxels ([0-9.e-]* in world units) of' report
holds "a check of few vertices finds no fault" "$deliso" check count.off builtin:fuel
"$deliso" builtin:fuel --triangles 6000 --json - -q >json
holds "--triangles counts triangles" grep -q '"triangles": 6000,$' json
holds "and says what stopped the number" grep -q '"count_stop": "none",$' json
holds "the JSON has the distance" grep -q '^  "max_distance": [0-9.e-]*,$' json

# The criteria go with the mesh, whatever its format, and a check judges by them: test_criteria_note
# has which.
for format in ply off obj stl vtp glb 3mf; do
  "$deliso" builtin:torus -q --max-distance 0.3vox --lambda 1.8 -o noted.$format
  "$deliso" check noted.$format builtin:torus >report
  holds "check of the $format file says so" grep -q ', judged by the criteria in its comment$' report
  holds "and judges by them" \
    grep -q '^criteria  h <= 0.3 voxels, r/l <= 1.8; r_min = 0.25 voxels$' report
done
for format in obj stl vtp glb 3mf; do
  "$deliso" check - builtin:torus <noted.$format >report
  holds "$format is known by its first bytes" grep -q '^criteria  h <= 0.3 voxels' report
done
"$deliso" check noted.ply builtin:torus --lambda 2.5 --rmin 0.7vox >report
holds "options go before" grep -q '^criteria  h <= 0.3 voxels, r/l <= 2.5; r_min = 0.7 voxels$' report
"$deliso" check noted.ply builtin:torus --paper --json paper.json >report
holds "--paper is the published h/r, and no distance" grep -q '^criteria  r/l <= 2, h/r <= 0.1; ' report
holds "in the JSON too" grep -q '"max_distance_voxels": null' paper.json
sed '/^# deliso /d' noted.obj >bare.obj
"$deliso" check bare.obj builtin:torus --json bare.json >report
holds "without the line, the defaults" \
  grep -q '^criteria  h <= 0.1 voxels, r/l <= 2; r_min = 0.25 voxels$' report
holds "of which some are passed" \
  grep -q '^          of [0-9]* triangles [0-9]* ([0-9.e-]* %) over a limit: ' report
holds "which is no fault" grep -q '^faults    none$' report
holds "the JSON says whose criteria" grep -q '"criteria_of_file": false' bare.json
status=0
"$deliso" check bare.obj builtin:torus --max-distance 0.1vox >report || status=$?
holds "but a distance that is asked for is required" [ "$status" -eq 1 ]
holds "of points" grep -q '^FAULT     too far: ' report
holds "and one that is kept is no fault" \
  "$deliso" check bare.obj builtin:torus --max-distance 1vox -q
sed 's/^# deliso .*/# deliso 0.1.0 r-min=1e999 lambda=none/' noted.obj >damaged.obj
"$deliso" check damaged.obj builtin:torus >report
holds "a damaged line is none" \
  grep -q '^criteria  h <= 0.1 voxels, r/l <= 2; r_min = 0.25 voxels$' report

# More than ten million vertices are announced, before the work and on one line.
status=0
set -- builtin:sphere --max-distance 1e-6vox --rmin 0.001vox --max-vertices 1000
"$deliso" "$@" -o many.ply 2>stderr >stdout || status=$?
holds "and the work goes on, here to its own end" [ "$status" -eq 2 ]
holds "with one line of warning" [ "$(grep -c '^deliso: warning: about [0-9]* million vertices' stderr)" -eq 1 ]
holds "and one of its own" [ "$(wc -l <stderr)" -eq 2 ]
"$deliso" "$@" -o many.ply -q 2>quiet >stdout || :
holds "-q hides neither" cmp stderr quiet

# The share of restricted Delaunay triangles is a number, and a fault on request alone.
"$deliso" builtin:noise:16 --check -q -o noise.ply
status=0
"$deliso" check noise.ply builtin:noise:16 --restricted 1 >report || status=$?
holds "but one that is asked for is" [ "$status" -eq 1 ]
holds "and named" grep -q '^FAULT     restricted share: ' report
holds "points are told apart by r_min" grep -q "voxels: [0-9]* above r_min, [0-9]* below$" report

# Values beside the mesh, which change nothing else; a check of the file finds no fault.
for format in ply vtp; do
  "$deliso" builtin:fuel:32 --cap -q --attributes -o values.$format
  holds "check reads a $format file with attributes" "$deliso" check values.$format builtin:fuel:32 --cap -q
done
"$deliso" builtin:fuel:32 --cap -q --attributes -o values.glb
holds "glTF has them too" grep -q -a '"NORMAL":1,"_COMPONENT":2,"_DISTANCE":3' values.glb
"$deliso" builtin:fuel:32 --cap -q --ply-ascii -o plain.ply
"$deliso" builtin:fuel:32 --cap -q --ply-ascii --attributes -o values.ply
sed '1,/^end_header/d' plain.ply >plain
sed '1,/^end_header/d' values.ply | awk 'NF == 6 { print $1, $2, $3 } NF == 7 { print $1, $2, $3, $4 }' >same
holds "points and triangles are the same with attributes" cmp -s plain same

# TetGen's files mark caps.
"$deliso" builtin:fuel:32 --cap --json caps.json -q -o caps.smesh
caps=$(sed -n 's/^ *"cap_triangles": \([0-9]*\),$/\1/p' caps.json)
holds "caps have the marker 2" [ "$(grep -c '^3 [0-9]* [0-9]* [0-9]* 2$' caps.smesh)" -eq "$caps" ]

# Solids: test_close_on_box.cpp and test_verify.cpp have what makes one.
"$deliso" builtin:gyroid:24 --cap --check --json solid.json -o solid.ply >report
holds "--cap gives a solid without a fault" grep -q '^faults    none' report
holds "and tells its volume" grep -q '"volume": 60[0-9][0-9]\.' solid.json
for file in solid.ply "solid.ply --float" solid.stl; do
  # shellcheck disable=SC2086
  "$deliso" builtin:gyroid:24 --cap -o $file >report
  holds "a solid in $file crosses nothing" grep -q '^ *0 crossing pairs of triangles' report
  holds "and check --cap finds no fault" \
    "$deliso" check ${file%% *} builtin:gyroid:24 --cap --restricted 0 -q
done
head -c 64 /dev/zero | tr '\0' '\1' >full.raw
"$deliso" full.raw --dims 4x4x4 --type uint8 --label 1 --cap -o full.ply >report
holds "a solid of caps alone has no angles of the surface" \
  [ "$(grep -c '^solid     volume 27;\|^quality\|^distance' report)" -eq 1 ]
"$deliso" builtin:gyroid:24 -q -o open.ply
status=0
"$deliso" check open.ply builtin:gyroid:24 --cap >report || status=$?
holds "an open mesh is no solid" [ "$status" -eq 1 ]
holds "for its holes" grep -q '^FAULT     holes' report
"$deliso" builtin:sphere --iso -1000 --cap --allow-empty -q -o full.off
holds "a full box is a box" grep -q -x '8 12 0' full.off
"$deliso" builtin:torus -q -o torus.ply

# --check, --allow-empty, --help, --version, info.
holds "--check finds no fault with the torus" "$deliso" builtin:torus -q --check
holds "check finds no fault with its file" "$deliso" check torus.ply builtin:torus -q
"$deliso" builtin:torus -q -o torus-float.ply --float
holds "nor with its file in single precision" "$deliso" check torus-float.ply builtin:torus -q
# A volume turned, moved and mirrored in the world: the mesh is written there, and checked there.
{
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 6 6 6\n'
  printf 'space directions: (0,2,0) (0.6,0,0.8) (0.8,0,-0.6)\nspace origin: (-40,25.5,1000)\n'
  printf 'encoding: ascii\n\n'
  awk 'BEGIN { for (n = 0; n < 216; n++) { i = n % 6 - 2.4; j = int(n / 6) % 6 - 2.6
    k = int(n / 36) - 2.5; print int(200 - 12 * (i * i + j * j + 2 * k * k)) "" } }' |
    sed 's/^-.*/0/'
} >turned.nrrd
sed 's/(0,2,0) (0.6,0,0.8) (0.8,0,-0.6)/(0,2,0) (0.6,0,0.8) (-0.8,0,0.6)/' turned.nrrd >mirrored.nrrd
for name in turned mirrored; do
  for precision in --double --float; do
    "$deliso" $name.nrrd --iso 150.3 -q -o $name.ply $precision
    holds "check finds no fault with a $name volume's mesh, $precision" \
      "$deliso" check $name.ply $name.nrrd --iso 150.3 -q --restricted 0.9
  done
  for format in stl vtp glb 3mf; do
    "$deliso" $name.nrrd --iso 150.3 -q -o $name.$format
    holds "nor in $format" "$deliso" check $name.$format $name.nrrd --iso 150.3 -q --restricted 0.9
  done
done
# The mesh of --space has x and y of the other sign, and check and render know it by its header.
for format in ply off obj stl vtp glb 3mf; do
  "$deliso" turned.nrrd --iso 150.3 -q --space RAS -o ras.$format
  holds "check turns the volume to the space of a .$format" \
    "$deliso" check ras.$format turned.nrrd --iso 150.3 -q --restricted 0.9
done
"$deliso" turned.nrrd --iso 150.3 -q -o lps.obj
holds "x and y have the other sign, to the last digit" [ "$(grep '^v' lps.obj)" = \
  "$(awk '/^v/ { for (n = 2; n < 4; ++n) $n = $n ~ /^-/ ? substr($n, 2) : $n == 0 ? $n : "-" $n
    print }' ras.obj)" ]
holds "and triangles face the same side" [ "$(grep '^f' lps.obj)" = "$(grep '^f' ras.obj)" ]
"$deliso" render ras.off --axes -q -o named.png
sed 's/ SPACE=RAS//' ras.off >no-space.off
"$deliso" render no-space.off --axes -q -o nameless.png
status=0
cmp -s named.png nameless.png || status=$?
holds "render names the patient's directions" [ "$status" -eq 1 ]
holds "a mesh that names none is where --space says" \
  "$deliso" check no-space.off turned.nrrd --iso 150.3 -q --restricted 0.9 --space RAS
"$deliso" render ras.ply --volume turned.nrrd --iso 150.3 --clip x:0.5 --section -q -o ras.png
"$deliso" render no-space.off --volume turned.nrrd --space RAS --iso 150.3 --clip x:0.5 --section \
  -q -o no-space.png
holds "a section is where the mesh is" cmp ras.png no-space.png
"$deliso" render ras.ply --clip x:0.5 -q -o open.png
status=0
cmp -s ras.png open.png || status=$?
holds "and fills the cut" [ "$status" -eq 1 ]
for n in 1 2; do
  "$deliso" turned.nrrd --iso 150.3 -q --space RAS --block-side 4 --part $n/2 -o ras-$n.part
done
"$deliso" turned.nrrd --iso 150.3 -q --space RAS --block-side 4 -o ras.ply
"$deliso" join ras-?.part --volume turned.nrrd -q -o joined.ply
holds "parts are joined in their space" cmp ras.ply joined.ply
holds "the mesh says whose x, y, z it has" grep -q -a -x 'comment DelIso SPACE=LPS' turned.ply
holds "and by which criteria, in voxels of 1" \
  grep -q -a -x 'comment deliso [0-9.]* r-min=0.25 max-distance=0.1 lambda=2' turned.ply
"$deliso" check turned.ply turned.nrrd --iso 150.3 --restricted 0.9 >report
holds "which hold where it was made" grep -q '^criteria  h <= 0.1 voxels, ' report
"$deliso" info mirrored.nrrd >facts
"$deliso" info turned.nrrd >>facts
holds "one of the two is left-handed" [ "$(grep -c left-handed facts)" -eq 1 ]
status=0
"$deliso" check turned.ply mirrored.nrrd --iso 150.3 -q --restricted 0.9 || status=$?
holds "a mesh in another place is at fault" [ "$status" -eq 1 ]

status=0
"$deliso" check torus.ply builtin:sphere --json faults.json >report || status=$?
holds "check exits 1 on a fault" [ "$status" -eq 1 ]
holds "and names it" grep -q '^FAULT' report
holds "in the JSON too" grep -q '"what": ' faults.json
"$deliso" builtin:sphere --iso 1000 --allow-empty -q -o empty.off
holds "an empty mesh on request" grep -q -x '0 0 0' empty.off
# Where the published tests leave vertices without a disk, the report tells.
for quiet in '' --quiet; do
  status=0
  # shellcheck disable=SC2086
  "$deliso" builtin:noise:16 --paper --rmin 2vox --lines 500 --max-vertices 20000 $quiet >report ||
    status=$?
  holds "a mesh that breaks a rule is exit 1" [ "$status" -eq 1 ]
  [ -n "$quiet" ] || holds "and the report says which" grep -q '^fault  *facet .* inside the box' report
done
"$deliso" --help >help
holds "--help is on standard output" [ -s help ]
"$deliso" --version >version
holds "--version" grep -q -x 'deliso [0-9.]*' version
"$deliso" info builtin:torus >facts
holds "info" grep -q '1 component, Euler number 0, 0 boundary loops' facts

# A picture of every format that can be read, the same from each, in a file and on standard output.
for format in ply off obj vtp 3mf; do
  "$deliso" builtin:sphere -q -o drawn.$format
  "$deliso" render drawn.$format -q -o $format.png --size 200x150 >stdout 2>stderr
  holds "-q is quiet with pictures" empty stdout stderr
  holds "the picture of the $format file is that of the PLY file" cmp -s $format.png ply.png
done
"$deliso" render drawn.ply -o again.png --size 200x150 | sed 's/^\([0-9,]*\) .*/\1/' >triangles
for format in stl glb; do
  "$deliso" builtin:sphere -q -o drawn.$format
  "$deliso" render drawn.$format -o $format.png --size 200x150 >stdout
  sed 's/^\([0-9,]*\) .*/\1/' stdout >drawn
  holds "as many triangles are drawn from the $format file" cmp -s drawn triangles
done
"$deliso" render - -o - --size 200x150 <drawn.ply >piped.png 2>stderr
holds "standard output gets the bytes of the picture" cmp -s piped.png ply.png
holds "then the report is on standard error" grep -q 'triangles drawn from --view' stderr
printf '\211PNG' >signature
head -c 4 ply.png >begin
holds "PNG" cmp -s signature begin
"$deliso" render drawn.ply -q -o clipped.png --size 200x150 --clip x:0.5
holds "a clipped picture is another" differ clipped.png ply.png
"$deliso" render drawn.ply - -o pair.png --size 402x150 --clip off/x:0.5 <drawn.off >stdout
holds "several meshes, one picture" \
  grep -q '^[0-9,]* triangles | [0-9,]* triangles drawn from --view' stdout
holds "of the size asked for" [ "$(od -An -tu1 -j16 -N8 pair.png | tr -s ' ')" = " 0 0 1 146 0 0 0 150" ]
"$deliso" render drawn.ply -q -o red.png --size 200x150 --color-by component
holds "colors change a picture" differ red.png ply.png
"$deliso" render drawn.ply -q -o angle.png --size 200x150 --color-by angle --labels auto
holds "and so do labels and a color bar" differ angle.png red.png

# Pages: of one mesh or two, in a file and on standard output, the same bytes every time.
"$deliso" view drawn.ply -q -o page.html >stdout 2>stderr
holds "-q is quiet with pages" empty stdout stderr
holds "a page" grep -q '^<!DOCTYPE html>' page.html
holds "its title is the mesh's name" grep -q '^<title>drawn.ply</title>$' page.html
"$deliso" view - -q -o - <drawn.ply | sed 's/standard input/drawn.ply/g' >piped.html
holds "standard output gets the bytes of the page" cmp -s page.html piped.html
"$deliso" view drawn.ply drawn.off --volume builtin:sphere -o pair.html >stdout
holds "two meshes, one page" grep -q '^[0-9,]* triangles | [0-9,]* triangles in pair.html$' stdout
holds "with distances from the volume's surface" grep -q '"h1":{"type":"f32"' pair.html

# Numbers too small for exact predicates are 0 for a check: a fault, and the end of it.
printf 'OFF\n4 4 0\n0 0 1e-320\n1e-50 0 0\n0 9 -4e-200\n3 1 9\n' >tiny.off
printf '3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n' >>tiny.off
status=0
"$deliso" check tiny.off builtin:sphere >report || status=$?
holds "a mesh of tiny coordinates is checked" [ "$status" -eq 1 ]
holds "its corners at 0 are one" grep -q '^FAULT ' report

# One array of several: test_named_arrays.cpp has which.
{
  printf '# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n'
  printf 'SPACING 1 1 1\nORIGIN 0 0 0\nPOINT_DATA 8\nSCALARS first float 1\nLOOKUP_TABLE default\n'
  printf '0 1 2 3 4 5 6 7\nFIELD FieldData 1\nsecond 1 8 short\n10 11 12 13 14 15 16 19\n'
} >two.vtk
"$deliso" info two.vtk --json two.json >facts
holds "the first array is read, and said" grep -q -x '          array first: float32, read' facts
holds "all are listed" grep -q -x '          array second: int16' facts
holds "the JSON has them" grep -q '^      "second": {$' two.json
"$deliso" info two.vtk --array second >facts
holds "the one that is named is read" grep -q 'samples 10 to 19$' facts

# Noise far from the origin, where single precision makes triangles cross, of the solid and of the
# open mesh; double precision does not.
noise_at() {
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 8 8 8\nspace: left-posterior-superior\n'
  printf 'space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (%s,%s,%s)\n' "$1" "$1" "$1"
  printf 'encoding: raw\n\n'
  # shellcheck disable=SC2059
  printf "$(awk 'BEGIN {
    x = 1
    for (n = 0; n < 512; ++n) { x = (x * 16807) % 2147483647; printf "\\%03o", x % 256 }
  }')"
}
noise_at 600000 >far.nrrd
noise_at 200000 >nearer.nrrd
formats='\.ply, \.off, \.obj, \.vtp, \.3mf, \.smesh and \.poly keep doubles'
for cap in '' --cap; do
  for out in far.stl "far.ply --float"; do
    status=0
    # shellcheck disable=SC2086
    "$deliso" far.nrrd --iso 100 --rmin 0.05vox --max-distance 0.01vox $cap -o $out \
      --json far.json >report || status=$?
    holds "pairs that rounding made in $out $cap are a fault" [ "$status" -eq 1 ]
    pairs=$(sed -n "s/^rounding  FAULT: single precision makes \([1-9][0-9]*\) pairs of triangles cross[,;].* $formats.*/\1/p" report)
    holds "which one line tells" [ "${pairs:-0}" -gt 0 ]
    holds "and the JSON" grep -q "\"crossings_by_rounding\": $pairs\b" far.json
  done
  # shellcheck disable=SC2086
  "$deliso" far.nrrd --iso 100 --rmin 0.05vox --max-distance 0.01vox $cap -o doubles.ply >report
  holds "doubles cross nowhere $cap" [ "$(grep -c '^rounding' report)" -eq 0 ]
done
status=0
"$deliso" check far.stl far.nrrd --iso 100 --cap --restricted 0 >report || status=$?
holds "check finds some of them in the file, where vertices at one place are one" \
  grep -q '^FAULT     self-intersections: [1-9][0-9]*$' report
holds "and says why" grep -q 'single precision, which may be why .* keep doubles' report

# Where fewer are at fault, some vertices are written at another float.
for cap in '' --cap; do
  for out in mended.stl "mended.ply --float"; do
    # shellcheck disable=SC2086
    "$deliso" nearer.nrrd --iso 98 --rmin 0.3vox --max-distance 0.02vox $cap -o $out \
      --json mended.json >report
    holds "what rounding does in $out $cap is mended" \
      grep -q '^rounding  [0-9]* vert[a-z]* not at the nearest float' report
    holds "as the JSON says" grep -q '"mended_vertices": [1-9]' mended.json
    "$deliso" check ${out%% *} nearer.nrrd --iso 98 $cap --restricted 0 >report
    holds "and check finds no fault in the file" grep -q '^faults    none$' report
  done
done

# One part is meshed, joined and checked at one isovalue, also where samples equal it.
head -c 64 /dev/zero >one.raw
for row in 21 25 37 41; do
  printf '\377\377' | dd of=one.raw bs=1 seek=$row conv=notrunc 2>/dev/null
done
set -- one.raw --dims 4x4x4 --type uint8 --iso 255
"$deliso" "$@" -q -o whole.ply
"$deliso" "$@" -q --part 1/1 -o one.part
"$deliso" join one.part --volume one.raw -o joined.ply -q
holds "one part, joined, is the whole" cmp -s joined.ply whole.ply
holds "one part, joined, passes check" "$deliso" check joined.ply "$@" --restricted 0 -q

# A join has the report of one process, but for the range of the samples and warnings of them: it
# does not read all.
# It died of fields that are filtered part by part, except with -q. Random samples of few values
# have a mesh with folds, which only the samples tell from folds of the surface.
{
  printf 'NRRD0004\ntype: float\ndimension: 3\nsizes: 12 12 12\nencoding: ascii\n\n'
  awk 'BEGIN { s = 7; for (n = 0; n < 1728; n++) { s = s * 16807 % 2147483647; print s % 4 } }'
} >plateau.nrrd
told() {
  sed 's/, samples .* to .*//;/^cost /d' report
  sed '/"seconds": {/,/}/d;/"range": /d;/"peak_memory_bytes": /d;/"diagnostics": /,$d;s/,$//' mesh.json
}
for options in '--iso 2' '--iso 2 --median 1' '--iso 2 --smooth 0.5vox' '--iso 2 --median 1 --cap' \
  '--label 1' '--label 1 --cap'; do
  set -- plateau.nrrd --block-side 6
  # shellcheck disable=SC2086
  {
    "$deliso" "$@" $options -o mesh.ply --json mesh.json >report 2>/dev/null
    mv mesh.ply whole.ply
    told >whole
    for n in 1 2; do "$deliso" "$@" $options -q --part $n/2 -o $n.part; done
  }
  "$deliso" join 2.part 1.part --volume plateau.nrrd -o mesh.ply --json mesh.json >report 2>/dev/null
  told >joined
  holds "parts with $options have the report of one process" cmp whole joined
  holds "and its mesh" cmp -s mesh.ply whole.ply
  "$deliso" join 2.part 1.part --volume plateau.nrrd -o mesh.ply -q
  holds "with -q, too" cmp -s mesh.ply whole.ply
  case $options in *median*) holds "with folds" grep -q 'folded on each other' joined ;; esac
done

# A raw file by its options, from a file and from standard input, and with a --roi that is all of it.
# The field is a block of 2 x 2 x 2 samples amid 4 x 4 x 4.
head -c 64 /dev/zero >block.raw
for row in 21 25 37 41; do
  printf '\377\377' | dd of=block.raw bs=1 seek=$row conv=notrunc 2>/dev/null
done
set -- --dims 4x4x4 --type uint8 --iso 100 -q
"$deliso" block.raw "$@" -o file.ply
"$deliso" - "$@" -o stdin.ply <block.raw
"$deliso" block.raw "$@" -o roi.ply --roi 0:4,0:4,0:4
holds "standard input gives the file's mesh" cmp -s file.ply stdin.ply
holds "the whole as --roi gives the file's mesh" cmp -s file.ply roi.ply
"$deliso" render - -o far.png --color-by distance --volume block.raw "$@" <file.ply
"$deliso" render file.ply -o far2.png --color-by distance --volume - "$@" <block.raw
holds "pictures get the volume of their colors from a file or from standard input" \
  cmp -s far.png far2.png

# Control characters of names and of a file's text do not reach the terminal.
evil=$(printf 'a\033[31m\nEVIL')
printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 2 2\nencoding: ascii\n\n0 0 0 0 0 0 0 9\n' \
  >"$evil.nrrd"
mkdir evil
{
  "$deliso" info "$evil.nrrd"
  "$deliso" "$evil.nrrd" --iso 5 -o "$evil.ply" --ply-ascii
  sed "s/^comment deliso/& smooth=1$(printf '\033')/" "$evil.ply" >"$evil.2.ply"
  "$deliso" check "$evil.2.ply" "$evil.nrrd" --iso 5
  "$deliso" "$evil.nrrd" --iso 5 --part 1/1 -o "$evil.part"
  "$deliso" join "$evil.part" --volume "$evil.nrrd" -o "evil/$evil.ply"
  "$deliso" trace "$evil.nrrd" --iso 5 -o "evil/$evil.html"
  "$deliso" view "$evil.ply" -o "evil/$evil.2.html"
  "$deliso" render "$evil.ply" -o "evil/$evil.png"
  "$deliso" info "evil/$evil.nrrd" || :
} >said 2>&1
holds "every name is said" [ "$(grep -c 'a?\[31m?EVIL' said)" -ge 10 ]
holds "no escape is" [ "$(tr -d '\n' <said | grep -c '[[:cntrl:]]')" -eq 0 ]
holds "no line of its own" [ "$(grep -c '^EVIL' said)" -eq 0 ]

# A segment's own color is that of its object, and of its triangles in a picture.
{
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 4 4 4\nencoding: ascii\n'
  printf 'Segment0_Name:=a\nSegment0_LabelValue:=1\nSegment0_Color:=1 0.5 0\n\n'
  awk 'BEGIN { for (n = 0; n < 64; n++) print (n % 4 < 2) + 0 }'
} >colored.seg.nrrd
for more in '' '--shared colored.ply'; do
  for format in glb 3mf; do
    # shellcheck disable=SC2086
    "$deliso" colored.seg.nrrd --label all --cap -q -o colored.$format $more
    "$deliso" render colored.$format --color-by label --occlusion off --view 0,0 -q -o $format.png
  done
  holds "a segment's color in glTF" grep -a -q 'baseColorFactor":\[1,0.2167' colored.glb
  holds "glTF and 3MF have one color" cmp glb.png 3mf.png
done

# Labels and gray images are told from each other, by one rule.
printf '\0\0\0\0\377\377\377\377' >mask8.raw
cat mask8.raw mask8.raw mask8.raw mask8.raw mask8.raw mask8.raw mask8.raw mask8.raw >mask64.raw
cat mask64.raw mask64.raw mask64.raw mask64.raw mask64.raw mask64.raw mask64.raw mask64.raw >mask.raw
set -- mask.raw --dims 8x8x8 --type uint8
"$deliso" info "$@" --json info.json >report
holds "info proposes the label of a mask" grep -q '^try       --label 255       256 samples$' report
holds "then its isovalue" grep -q '^or        --iso ' report
holds "the JSON says so" grep -q '^  "looks_like_labels": true,$' info.json
"$deliso" "$@" --label 255 --cap -o mask.ply >stdout 2>stderr
holds "and --label is as it was" empty stderr
"$deliso" info builtin:fuel --json info.json >report
holds "info proposes isovalues of a gray image" grep -q '^try       --iso ' report
holds "and no label" [ "$(grep -c -e '--label' report)" -eq 0 ]
holds "the JSON says this too" grep -q '^  "looks_like_labels": false,$' info.json
# A ramp of 20 values, since each is meshed: the beginning of the program as an image took a minute.
{
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 20 3 3\nencoding: ascii\n\n'
  awk 'BEGIN { for (n = 0; n < 180; ++n) print n % 20 }'
} >gray.nrrd
for label in 0 all; do
  "$deliso" gray.nrrd --label $label -o gray-%d.ply >stdout 2>stderr || :
  holds "--label of a gray image warns once" [ "$(grep -c . stderr)" -eq 1 ]
  holds "with the isovalue" \
    grep -q '^deliso: warning: gray.nrrd: looks like a gray image, not like labels: try --iso ' stderr
done

ls -A >names
holds "no temporary file is left" [ "$(grep -c tmp names)" -eq 0 ]
# A segmentation as one file: an object for each label, which is drawn and named.
awk 'BEGIN { for (n = 0; n < 4096; ++n) { i = n % 16; j = int(n / 16) % 16
  inside = i > 2 && i < 13 && j > 2 && j < 13 && n > 768 && n < 3328
  printf "%s ", inside ? (i < 8 ? 2 : 5) : 0 } }' >numbers
{
  printf 'NRRD0004\ntype: uint8\ndimension: 3\nsizes: 16 16 16\nencoding: ascii\n'
  printf 'Segment0_Name:=Liver\nSegment0_LabelValue:=5\n\n'
  cat numbers
} >organs.nrrd
for format in glb 3mf vtp; do
  "$deliso" organs.nrrd --label all -o organs.$format --json organ-%d.json >table 2>stderr
  holds "one $format of all labels, and a row for each" [ "$(grep -c exact table)" -eq 2 ]
  holds "with a report for each" [ -s organ-2.json -a -s organ-5.json ]
  "$deliso" render organs.$format --color-by component -o organs.png >stdout
  holds "both are in the $format file" grep -q ', 2 components drawn' stdout
  "$deliso" organs.nrrd --label all -o - --format $format >piped 2>stderr
  holds "standard output gets the bytes" cmp -s organs.$format piped
  holds "then the table is on standard error" grep -q exact stderr
done
holds "objects are named by segment or label" grep -q -a '"name":"label 2".*"name":"Liver"' organs.glb
"$deliso" organs.nrrd --label all -o organ-%d.glb -q
holds "or a file for each" [ -s organ-2.glb -a -s organ-5.glb ]
"$deliso" check organ-2.glb organs.nrrd --label 2 >stdout 2>stderr || :
holds "which says its label" empty stderr
"$deliso" check organs.glb organs.nrrd --label 2 >stdout 2>stderr || :
holds "as that of all does" grep -q 'its file says label=all, this check says label=2' stderr

all_hold 200

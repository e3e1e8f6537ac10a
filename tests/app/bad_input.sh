#!/bin/sh
# SPDX-License-Identifier: MIT
# Bad input and failing output: one line on standard error, exit 2, nothing on standard output,
# nothing half-written. Usage: bad_input.sh PROGRAM
set -eu
deliso=$1
work=$(mktemp -d)
trap 'umount "$work/disk" 2>/dev/null || :; rm -rf "$work"' EXIT
cd "$work"
mkdir out

cases=0
faults=0
fault() {
  echo "FAULT: $*"
  sed 's/^/  stderr: /' err
  faults=$((faults + 1))
}

# refuses PATTERN ARGUMENT...: the program must refuse, with a message that PATTERN matches.
refuses() {
  pattern=$1
  shift
  : >stdout
  refuses_to stdout "$pattern" "$@"
  [ ! -s stdout ] || fault "standard output for: $*"
}

# The same with standard output going to a file of one's choice.
refuses_to() {
  to=$1
  pattern=$2
  shift 2
  cases=$((cases + 1))
  status=0
  "$deliso" "$@" >"$to" 2>err </dev/null || status=$?
  [ "$status" -eq 2 ] || fault "exit $status for: $*"
  [ "$(wc -l <err)" -eq 1 ] || fault "not one line for: $*"
  grep -q '^deliso: ' err || fault "no 'deliso: ' for: $*"
  grep -q -e "$pattern" err || fault "no '$pattern' for: $*"
  [ -z "$(ls -A out)" ] || fault "left in the output folder: $(ls -A out) for: $*"
}

# header NAME TYPE DATA: an .nhdr of 4 x 4 x 4 samples.
header() {
  printf 'NRRD0004\ntype: %s\ndimension: 3\nsizes: 4 4 4\nspacings: 1 1 1\n' "$2" >"$1"
  printf 'endian: little\nencoding: raw\ndata file: %s\n' "$3" >>"$1"
}

o=out/mesh.ply
raw='--dims 4x4x4 --type uint8'

# Volumes that cannot be read: one of each kind; tests/io/test_faults.cpp has the messages of the readers.
refuses '^deliso: nowhere.nhdr: cannot open: No such file or directory$' nowhere.nhdr --iso 1 -o $o
head -c 64 /dev/zero >whole.raw
head -c 63 /dev/zero >short.raw
header short.nhdr uint8 short.raw
refuses '^deliso: short.raw: data is too short: ' short.nhdr --iso 0.5 -o $o
refuses 'out: is a folder without slices' out --iso 0.5 -o $o
refuses 'standard input: is empty' - --iso 0.5 -o $o
refuses "no built-in field 'nothing' (there are sphere, torus, " builtin:nothing --iso 0.5 -o $o
refuses 'region 0:1000000 along x is not' builtin:sphere --roi 0:1000000,0:4,0:4 -o $o
refuses "no named arrays to take 'density' of" builtin:sphere --array density -o $o
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e306 0\n3 0 1 2\n' >inf.off
refuses 'inf.off.*coordinate y of vertex 2 is 1e+306' check inf.off builtin:fuel

# A NaN and an infinite sample, named by their index: sample (1,0,2) is number 33. Each command that
# makes a field of them says so.
sample() {
  head -c 256 /dev/zero >float.raw
  # shellcheck disable=SC2059
  printf "$1" | dd of=float.raw bs=4 seek=33 conv=notrunc 2>/dev/null
  header float.nhdr float float.raw
}
sample '\000\000\300\177'
refuses 'float.nhdr: NaN sample at (1, 0, 2): --nan VALUE gives' float.nhdr --iso 0.5 -o $o
refuses 'float.nhdr: NaN sample at (1, 0, 2)' float.nhdr --label 1 -o $o
sample '\000\000\200\177'
refuses 'float.nhdr: infinite sample at (1, 0, 2)' info float.nhdr
refuses 'float.nhdr: infinite sample at (1, 0, 2)' float.nhdr --iso 0.5 --smooth 1 -o $o
sample '\000\000\300\077'
refuses 'float.nhdr: the sample at (1, 0, 2) is 1.5, and labels are whole' float.nhdr --label 1 -o $o
refuses 'float.nhdr: the sample' float.nhdr --label all -o out/part-%d.ply

# Fields and isovalues without a surface, and what cannot be taken on: the message names the limit.
# shellcheck disable=SC2086
{
  refuses "whole.raw: has no segment 'Liver': --label takes whole" whole.raw $raw --label Liver -o $o
  refuses "whole.raw: names no patient's space, RAS or LPS, that --space could turn" \
    whole.raw $raw --iso 1 --space RAS -o $o
  refuses 'no sample has label 7: its 1 labels are 0' whole.raw $raw --label 7 -o $o
  refuses 'has no label but 0' whole.raw $raw --label all -o out/part-%d.ply
  refuses 'no surface' whole.raw $raw --label 0 -o $o
  refuses 'the samples are 0 to 0, everything is inside' whole.raw $raw --iso -1 -o $o
  refuses 'everything is outside' whole.raw $raw --iso 1 -o $o
  for n in $(seq 32); do printf '\000\377'; done >stripes.raw
  refuses 'million vertices' stripes.raw $raw --spacing 1,1,4e9 --max-distance 0.1 --rmin 0.001vox \
    --iso 9.5 -o $o
}
refuses 'no surface at isovalue 1000' builtin:sphere --iso 1000 -o $o
refuses 'samples along x, and must be at most 100' builtin:sphere --smooth 200 -o $o
refuses 'changes nothing' builtin:sphere --smooth 0.001vox -o $o
refuses 'r_min (--rmin) is .* at least 0.001' builtin:sphere --rmin 1e-12 -o $o
refuses 'more than --max-vertices 10 vertices' builtin:fuel --max-vertices 10 -o $o
refuses 'million vertices' builtin:fuel --rmin 0.001vox --max-distance 1e-12 --max-radius 1e-9 -o $o
refuses 'million vertices' builtin:noise --max-distance 1e-7 --rmin 0.001vox --max-radius 0.003 -o $o
refuses '^deliso: --facet-cycles belongs to --paper, the algorithm as published$' builtin:fuel --facet-cycles -o $o
refuses 'none of the 0 random lines meets the surface' builtin:sphere --paper --lines 0 -o $o
refuses 'more than --max-vertices 100 vertices' builtin:fuel --paper --max-vertices 100 -o $o

# Command lines: test_command_line.cpp has all of their messages.
refuses '^deliso: no input given; --help shows how$'
refuses "^deliso: unknown option '--ios'; did you mean --iso?$" builtin:sphere --ios 0.5 -o $o
refuses '^deliso: --eps has no meaning for deliso info$' info builtin:sphere --eps 1

# Pictures and pages.
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >one.off
printf 'OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n' >none.off
printf 'OFF\n3 1 0\n1e6 0 0\n1e6 1 0\n1e6 0 1\n3 0 1 2\n' >far.off
: >one.stl
p=out/picture.png
refuses 'missing.off: cannot open' render missing.off -o $p
refuses 'missing.off: cannot open' view missing.off -o out/page.html
refuses 'none.off.*no facets' render none.off -o $p
refuses 'one.off.*clipped' render one.off -o $p --clip 0,0,1,-1
refuses 'short' render one.off -o $p --color-by gradient --volume short.nhdr
refuses 'short' view one.off -o out/page.html --volume short.nhdr --iso 1
refuses 'no triangle is near' render far.off -o $p --color-by distance --volume builtin:sphere
refuses "'one.off'.* 20 pixels high has no room for labels" render one.off -o $p --labels auto --size 20x20
refuses 'no room for a color bar' render one.off -o $p --color-by angle --size 20x20
refuses 'one.stl.*ends within the header' render one.off one.stl -o $p
refuses 'no room for 3 panels' render one.off one.off one.off -o $p --size 6x6
refuses 'beside all that is drawn' render one.off -o $p --look-at 1e9,1e9,1e9

# One line, whatever names hold, and not all of a long one.
refuses 'two?lines' 'two
lines' --iso 1 -o $o
long=$(head -c 5000 /dev/zero | tr '\0' a)
for words in "$long --iso 1" "builtin:sphere --iso $long" "builtin:sphere --$long" \
  "builtin:sphere -o $long.ply" "builtin:sphere -o a.$long" "check $long.ply builtin:sphere"; do
  # shellcheck disable=SC2086
  refuses . $words
  [ "$(wc -c <err)" -lt 700 ] || fault "$(wc -c <err) bytes for a long name"
done

# No file of a run stands in for another one, however it is named: test_output.cpp has all pairs.
header pair.nhdr uint8 whole.raw
ln -s whole.raw link.raw
cp whole.raw data.copy
"$deliso" builtin:torus -q -o kept.ply
cp kept.ply mesh.copy
same='this run'
refuses "$same reads" pair.nhdr --iso 0.5 -o link.raw --format ply
refuses "$same reads" pair.nhdr --iso 0.5 --json whole.raw
refuses "$same reads" info pair.nhdr --json pair.nhdr
refuses "$same reads" check kept.ply builtin:torus --json kept.ply
# shellcheck disable=SC2086
refuses "$same writes" stripes.raw $raw --label all -o s%d.ply --shared s255.ply
refuses "$same writes" builtin:torus -o out/a.ply --json out/../out/a.ply
cmp -s whole.raw data.copy && cmp -s kept.ply mesh.copy || fault 'an input was replaced'

# Parts that do not belong together, or not to the volume, or are not as they were made.
volume=builtin:torus:24
for n in 1 2; do
  "$deliso" $volume --block-side 8 --part $n/2 -q -o part$n
  "$deliso" $volume --block-side 8 --iso 0.1 --part $n/2 -q -o other$n
done
refuses 'part 2 of 2 is missing' join part1 --volume $volume -o $o
refuses 'are both part 1 of 2' join part1 part2 part1 --volume $volume -o $o
refuses 'other2.*--iso=0.1 here' join part1 other2 --volume $volume -o $o
refuses 'part1.* is no part of .builtin:torus:25' join part1 part2 --volume builtin:torus:25 -o $o
refuses 'part1.* is no part of .builtin:linked_tori:24' join part1 part2 --volume builtin:linked_tori:24 -o $o
refuses 'kept.ply.* is no part of a mesh' join part1 kept.ply --volume $volume -o $o
refuses 'nowhere' join part1 nowhere --volume $volume -o $o
refuses "$same writes\|$same reads" join part1 part2 --volume $volume -o part2 --format ply
head -c 2000 part2 >short
refuses 'short.*cut short' join part1 short --volume $volume -o $o
tr '\100' '\101' <part2 >edited
refuses 'edited.* not as it was made' join part1 edited --volume $volume -o $o
sed '1s/part .*/part 0.0.0/' part2 >old
refuses 'old.* of another version' join part1 old --volume $volume -o $o

# Surfaces that bound no solid: test_solid_run.cpp has the messages.
s=out/solid.vtu
refuses 'missing.off: cannot open' solid missing.off -o $s
refuses 'none.off: has no triangle that bounds anything' solid none.off -o $s
refuses 'one.off: the surface is open at edge 0-1 at (0.5 0 0), and 2 more; a solid needs a closed' solid one.off -o $s
refuses "'kept.ply' has no solid format's ending (.mesh, " solid one.off -o kept.ply
refuses "$same reads" solid kept.ply -o kept.ply --format vtu
refuses 'no/such/s.vtu' solid kept.ply -o no/such/s.vtu
refuses 'three files' solid kept.ply -o - --format tetgen
refuses 'one.off' check one.off.mesh one.off
"$deliso" solid kept.ply -q -o kept.mesh
head -c 2000 kept.mesh >cut.mesh
refuses 'cut.mesh' check cut.mesh kept.ply

# Output that cannot be written.
refuses 'no/such/mesh.ply' builtin:sphere -o no/such/mesh.ply
refuses 'no/such/p.png' render one.off -o no/such/p.png
refuses 'no/such/a.json' builtin:sphere -o $o --json no/such/a.json
mkdir folder.ply
refuses 'folder.ply' builtin:sphere -o folder.ply
if [ "$(id -u)" -ne 0 ]; then
  mkdir locked
  chmod a-w locked
  refuses 'locked/mesh.ply' builtin:sphere -o locked/mesh.ply
fi
if [ -c /dev/full ]; then
  refuses '/dev/full' builtin:sphere -o /dev/full --format ply
  refuses_to /dev/full 'standard output' --help
  refuses_to /dev/full 'standard output' --version
  refuses_to /dev/full 'standard output' info builtin:sphere
  refuses_to /dev/full 'standard output' builtin:sphere
  refuses_to /dev/full 'standard output' builtin:sphere -q -o -
fi

# A limit of the shell's on the size of files, which the system tells of by a signal.
cases=$((cases + 1))
status=0
(ulimit -f 8 && "$deliso" builtin:fuel -q -o out/large.ply) 2>err || status=$?
[ "$status" -eq 2 ] || fault "exit $status beyond a limit on the size of files"
grep -q 'out/large.ply' err || fault 'no name of the file that grew too large'
[ -z "$(ls -A out)" ] || fault "left in the output folder: $(ls -A out)"

# A full disk. The old mesh must survive the attempt to replace it.
mkdir disk
if mount -t tmpfs -o size=64k tmpfs disk 2>/dev/null; then
  refuses 'disk/mesh.ply' builtin:fuel -o disk/mesh.ply
  [ -z "$(ls -A disk)" ] || fault "left on the full disk: $(ls -A disk)"
  echo old >disk/mesh.ply
  refuses 'disk/mesh.ply' builtin:fuel -o disk/mesh.ply
  [ "$(cat disk/mesh.ply)" = old ] || fault "the old mesh is gone"
  [ "$(ls -A disk)" = mesh.ply ] || fault "left on the full disk: $(ls -A disk)"
else
  echo 'no tmpfs can be mounted here: a full disk was only tried as /dev/full'
fi

echo "$cases cases, $faults faults"
[ "$cases" -ge 75 ] && [ "$faults" -eq 0 ]

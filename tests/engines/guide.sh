#!/bin/sh
# SPDX-License-Identifier: MIT
# What docs/guide/blocks.md shows for an engine, on that engine: 32 parts of a volume of 32 blocks,
# joined. The first try at one part comes to a bad end, and the page's commands are given again. The
# mesh has the bytes that one process makes. Usage: guide.sh make|slurm|snakemake SOURCE DELISO
set -eu
engine=$1
source=$(realpath "$2")
deliso=$(realpath "$3")
. "$source/tests/holds.sh"
if [ "$engine" = slurm ] && [ -z "${SLURM_CONF:-}" ]; then
  exec sh "$source/tests/engines/slurm_cluster.sh" sh "$0" "$@"
fi
case $engine in
  slurm) title='With Slurm' file=parts.sh ;;
  make) title='With make' file=Makefile ;;
  snakemake) title='With Snakemake' file=Snakefile ;;
esac
if [ "$engine" != slurm ] && ! command -v "$engine" >/dev/null; then
  echo "no $engine here: it was not tried"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
cd "$work"

# block N: the section's N-th block.
block() {
  awk -v title="## $title" -v wanted="$1" '/^## / { here = $0 == title }
    here && /^```/ { n += !inside; inside = !inside; next }
    here && inside && n == wanted' "$source/docs/guide/blocks.md"
}
block 1 >"$file"
block 2 >commands
[ -s "$file" ] && [ -s commands ]

# Balls that touch, around the corners of blocks: 64 samples a side, 4 x 4 x 2 times.
LC_ALL=C awk 'BEGIN {
  step = 6.2831853 / 64
  for (k = 0; k < 64; k++) {
    slice = ""
    for (j = 0; j < 64; j++) {
      row = ""
      for (i = 0; i < 64; i++) {
        value = 128 - 98 * (cos(i * step + 0.3) + cos(j * step + 0.7) + cos(k * step + 1.1))
        row = row sprintf("%c", value < 1 ? 1 : value > 255 ? 255 : int(value))
      }
      slice = slice row row row row
    }
    printf "%s%s%s%s", slice, slice, slice, slice
  }
}' >tile
cat tile tile >scan.raw
printf '%s\n' NRRD0004 'type: uint8' 'dimension: 3' 'sizes: 256 256 128' 'encoding: raw' \
  'data file: scan.raw' '' >scan.nhdr
"$deliso" scan.nhdr --iso 40.1 -q -o one.ply

# The program, but for the first try at part 7: it hangs on Slurm, where it is canceled, and is
# killed elsewhere.
mkdir bin
cat >bin/deliso <<END
#!/bin/sh
echo "\$*" >>"$work/calls"
case "\$*" in
  *'--part 7/32 '*)
    if [ ! -e "$work/tried" ]; then
      : >"$work/tried"
      [ $engine != slurm ] || exec sleep 600
      kill -9 \$\$
    fi
    ;;
esac
exec "$deliso" "\$@"
END
chmod +x bin/deliso
PATH=$work/bin:$PATH
HOME=$work
export PATH HOME
unset MAKEFLAGS MAKEOVERRIDES  # of the make that may run the tests

wait_for_queue() {
  for _ in $(seq 300); do
    [ -n "$(squeue --noheader)" ] || return 0
    sleep 0.2
  done
  squeue
  return 1
}
calls() { [ "$(grep -c -e "$1" calls)" -eq "$2" ]; }
fails() { ! "$@"; }

if [ "$engine" = slurm ]; then
  sh -e commands
  for _ in $(seq 300); do
    [ ! -e tried ] || break
    sleep 0.1
  done
  squeue
  task=$(squeue --noheader --array --states=running --format=%i | grep '_7$')
  scancel "$task"
  echo "canceled: $task"
  wait_for_queue
else
  holds 'a part that fails is told of' fails sh -e commands >first.out 2>&1
fi
holds 'no mesh of 31 parts' fails [ -e whole.ply ]
holds 'no join of 31 parts' calls '^join ' 0
holds 'the same commands again' sh -e commands
if [ "$engine" = slurm ]; then
  wait_for_queue
  cat slurm-*.out
fi
holds 'each part is made once, and one is tried twice' calls '--part ' 33
holds 'one join' calls '^join ' 1
holds 'the bytes of one process' cmp whole.ply one.ply
holds 'no fault' "$deliso" check whole.ply scan.nhdr --iso 40.1
all_hold 7

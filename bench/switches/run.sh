#!/bin/sh
# SPDX-License-Identifier: MIT
# What is each mechanism worth? Each patch here takes one out, or gives a constant another value that a
# record of docs/decisions.md names. Its head says what it does, whose record defends the mechanism
# ("Record: TITLE"), options that its runs need, if any ("Options: --vertices 10000"), and, where meshes
# do not tell what the mechanism is for, what does ("Judged: ..."): "by tests", which must fail with the
# switch as with a mutant ("Tests: ROOM", make mutants); "by instructions", counted by Valgrind;
# "by cores"; "by volumes", more than the table's; "by proof": its record names both; or "constant":
# neither value is better. A switch is made in a copy of the tree, where only what it touches is built
# again. Its program and the one without it mesh five volumes, each in several quarter turns, and
# `quality` measures the meshes.
# Usage: run.sh --check                   patches, records and the rows of the table fit together
#        run.sh BUILD PAGE DATA [NAME...] BUILD has bench/quality; all switches, or these. Their rows go
#                                         into PAGE's table. Programs and runs stay in BUILD/switches.
# Environment: JOBS (of the build), TURNS (3)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
. "$here/../patches.sh"

if [ "$1" = --check ]; then
  wrong=0
  for name in $(all_patches); do
    still_applies "$name" || wrong=1
    case $(head_of "$name" Judged):$(head_of "$name" Tests) in
      "by tests":?* | "by instructions": | "by volumes": | "by cores": | "by proof": | constant: | :) ;;
      *) echo "$name: \"Judged\" and \"Tests\" do not fit"; wrong=1 ;;
    esac
  done
  patches=$(for name in $(all_patches); do printf '%s\t%s\n' "$name" "$(head_of "$name" Record)"; done)
  awk -v patches="$patches" -f "$here/check.awk" "$source/docs/decisions.md" \
    "$source/docs/switches.md" || wrong=1
  echo "$(all_patches | wc -l | tr -d ' ') switches"
  exit "$wrong"
fi

build=$(cd "$1" && pwd)
page=$2
data=$3
shift 3
names=${*:-$(all_patches)}
work=$build/switches
volumes=TOOTH,LEG,BABY1,ANEURISM,noise:32
for volume in tooth leg baby aneurism; do
  [ -f "$data/$volume.nhdr" ] || volumes=fuel:48,gyroid:48,machine:48,linked_tori:64,noise:32
done

# Builds the program in the copy of the tree, as the file $1.
build_program() {
  cmake --build "$work/tree/build" -j "${JOBS:-1}" --target deliso_app >"$work/log" 2>&1 ||
    { tail -n 20 "$work/log" >&2; return 1; }
  cp "$work/tree/build/deliso" "$1"
}
# Writes the runs of the program $1, with the options given, to the file $2.
measure() {
  program=$1 runs=$2
  shift 2
  "$build/bench/quality" --program "$program" --beside "$work/base" --data "$data" --only "$volumes" \
    --turns "${TURNS:-3}" --limit 100 --runs "$runs.part" "$@" >/dev/null
  mv "$runs.part" "$runs"
}

# Prints the instructions of the program $1 with the options $2 on three built-in fields, a line each.
instructions() {
  for field in noise:32 gyroid:48 machine:48; do
    valgrind --tool=callgrind --callgrind-out-file=/dev/null "$1" "builtin:$field" $2 --threads 1 -q \
      -o "$work/counted.ply" 2>&1 | sed -n 's/.*Collected : //p'
  done
}

# The base is the tree as it is. Its runs have the options of all switches.
mkdir -p "$work"
rm -rf "$work/tree" "$work/built"
mkdir "$work/tree"
for item in "$source"/*; do
  [ -f "$item/CMakeCache.txt" ] || cp -Rp "$item" "$work/tree"
done
cmake -S "$work/tree" -B "$work/tree/build" -Wno-dev -DDELISO_WERROR=OFF -DDELISO_INSTALL=OFF \
  -DDELISO_BUILD_TESTS=OFF -DDELISO_BUILD_BENCH=OFF >"$work/log"
build_program "$work/new"
cp -Rp "$work/tree" "$work/built"
if ! cmp -s "$work/new" "$work/base" || [ ! -f "$work/base.tsv" ]; then
  echo 'base' >&2
  mv "$work/new" "$work/base"
  set -- --options ''
  for name in $(all_patches); do head_of "$name" Options; done | sort -u >"$work/options"
  while read -r options; do set -- "$@" --options "$options"; done <"$work/options"
  measure "$work/base" "$work/base.tsv" "$@"
fi

for name in $names; do
  echo "$name" >&2
  rm -rf "$work/tree"
  cp -Rp "$work/built" "$work/tree"
  apply "$name" "$work/tree"
  build_program "$work/$name"
  options=$(head_of "$name" Options)
  measure "$work/$name" "$work/$name.tsv" --options "$options"
  : >"$work/counts"
  judged=$(head_of "$name" Judged)
  if [ "$judged" = 'by instructions' ] && command -v valgrind >/dev/null; then
    instructions "$work/base" "$options" >"$work/base.counts"
    instructions "$work/$name" "$options" | paste "$work/base.counts" - >"$work/counts"
  fi
  rm "$work/$name"

  # The rows of this switch and of the base go into the page, below those of the others.
  "$build/bench/quality" --switches "$work/base.tsv" "$work/$name.tsv" --markdown |
    awk -v name="$name" -v judged="$judged" -f "$here/judge.awk" "$work/counts" - |
    awk -v on="$(echo "$volumes" | sed 's/,/, /g'), each in ${TURNS:-3} quarter turns" \
      -v day="$(date -u +%Y-%m-%d)" -f "$here/put.awk" - "$page" >"$work/page"
  cp "$work/page" "$page"
done
rm -rf "$work/tree" "$work/built"

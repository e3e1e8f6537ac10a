#!/bin/sh
# SPDX-License-Identifier: MIT
# Runs and compiles what a page shows, block by block (CONTRIBUTING.md, "Pages", has the rules), and
# says of each what became of it. WORK keeps what the blocks made.
# Usage: run_blocks.sh PAGE WORK PREFIX WRITE_VOLUMES CXX; the program is PREFIX/bin/deliso.
set -eu
page=$1
work=$2
prefix=$3
write_volumes=$4
tests=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$tests/../.." && pwd)
export CXX="$5"

rm -rf "$work"
mkdir -p "$work/blocks" "$work/scratch/build" "$work/home"
blocks=$(cd "$work/blocks" && pwd)
scratch=$(cd "$work/scratch" && pwd)
# The page's reader has installed the library into ~/.local and has the program built.
ln -s "$prefix" "$work/home/.local"
ln -s "$prefix/bin/deliso" "$scratch/build/deliso"
ln -s "$(cd "$(dirname "$write_volumes")/.." && pwd)/bench" "$scratch/build/bench"
ln -s "$source/examples" "$scratch/examples"
HOME=$(cd "$work/home" && pwd)
PATH=$prefix/bin:$tests:$PATH
CMAKE_PREFIX_PATH=$prefix
export HOME PATH CMAKE_PREFIX_PATH
library=$(find "$prefix" -name libdeliso.a)

awk -v out="$blocks" -f "$tests/split_page.awk" "$page" >"$blocks/index"
touch "$blocks/none.body" "$blocks/tested"
# shellcheck disable=SC2046
(cd "$scratch" && "$write_volumes" builtin:fuel:48 $(cat "$blocks"/*.body |
  grep -oE '(^|[[:space:]"=])[A-Za-z0-9_-]+\.(nrrd|nhdr|mha|mhd|nii|nii\.gz|vtk|vti|raw)\b' |
  tr -d ' \t"=' | sort -u))

faults=0
fault() {
  echo "FAULT: $page:$line: $1"
  faults=$((faults + 1))
}
told() { echo "$page:$line: $kind: $1"; }

# run COMMAND...: runs it in the scratch directory; its output is `output`.
run() {
  status=0
  (cd "$scratch" && "$@") >"$blocks/output" 2>&1 </dev/null || status=$?
  [ "$status" -eq 0 ] && return
  fault "exit status $status"
  sed 's/^/  | /' "$blocks/output"
  return 1
}

# A block with no main() is the inside of one, its includes apart.
program_of() {
  if grep -q 'int main(' "$1"; then
    cat "$1"
  else
    grep '^#include' "$1" || :
    echo 'int main() {'
    grep -v '^#include' "$1"
    echo '}'
  fi
}

# Whether a script names the page, or else has the first two words of each line of the block.
run_by() {
  grep -qF -e "${page##*/}" "$1" && return
  awk '{ print $1, $2 }' "$body" | while read -r words; do
    grep -qF -e "$words" "$1" || exit 1
  done
}

while IFS='	' read -r number line kind marker; do
  body=$blocks/$number.body
  what=${marker#*: }
  case $kind:$marker in
    fault:*) fault "$marker" ;;
    shows:*)
      # Of the last block that was run, and said by the page.
      if ! grep -qF -e "$marker" "$blocks/output"; then
        fault "'$marker' is not in the output above"
      elif ! grep -qF -e "$marker" "$blocks/prose"; then
        fault "'$marker' is not in the text of the page"
      else
        echo "$marker" >>"$blocks/tested"
        told "'$marker'"
      fi
      ;;
    number:*) ;;  # below
    *:"not run: "*) told "$marker" ;;
    *:"run by: "*)
      if run_by "$source/$what"; then told "$marker"; else fault "not run by $what"; fi
      ;;
    *:"code: "*)
      # shellcheck disable=SC2086
      if ! sh "$tests/code.sh" show $what >"$blocks/code" 2>"$blocks/diff"; then
        fault "$(cat "$blocks/diff")"
      elif ! diff "$body" "$blocks/code" >"$blocks/diff"; then
        fault 'other code than the source; "make pages" writes it'
        sed 's/^/  | /' "$blocks/diff"
      else
        told "$marker"
      fi
      ;;
    *:"file: "*)
      cp "$body" "$scratch/$what"
      told "is $what"
      ;;
    sh:-)
      if run sh -e "$body"; then told 'run'; fi
      ;;
    cpp:-)
      program_of "$body" >"$scratch/program.cpp"
      if run "$CXX" -std=c++20 -ffp-contract=off -I"$prefix/include" program.cpp -o program \
        "$library" -pthread && run ./program; then told 'compiled and run'; fi
      ;;
    text:-)
      if [ ! -e "$blocks/output" ]; then
        fault 'no block above has an output'
      elif ! awk -f "$tests/same_output.awk" "$body" "$blocks/output"; then
        fault 'the output above is another'
        sed 's/^/  | /' "$blocks/output"
      else
        cat "$body" >>"$blocks/tested"
        told 'compared'
      fi
      ;;
    *) fault "a block of '$kind' that is neither run nor said why not" ;;
  esac
done <"$blocks/index"

# In chapters a count in a sentence is one that was tested above. Tables may have measurements.
case $page in
  README.md | docs/guide/* | docs/proof*.md | tests/docs/faulty_page.md)
    awk -F '\t' '$3 == "number" { print $2, $4 }' "$blocks/index" >"$blocks/numbers"
    while read -r line number; do
      grep -qwF -e "$number" "$blocks/tested" || fault "no test reads $number"
    done <"$blocks/numbers"
    ;;
esac

# A picture that the page shows and its commands make is the same, byte for byte.
pictures=0
grep -oE '\]\([^ )]+\.png\)' "$page" | sed 's/^](//;s/)$//' | sort -u >"$blocks/pictures"
while read -r shown; do
  made=$scratch/${shown##*/}
  [ -e "$made" ] || continue
  pictures=$((pictures + 1))
  line=$(grep -nF "]($shown)" "$page" | cut -d : -f 1)
  cmp "$made" "$(dirname "$page")/$shown" || fault "the commands make another $shown"
done <"$blocks/pictures"

echo "$(grep -cvE '	(shows|fault|number)	' "$blocks/index") blocks, $pictures pictures, $faults faults"
[ "$faults" -eq 0 ]

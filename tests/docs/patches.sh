#!/bin/sh
# SPDX-License-Identifier: MIT
# The changes that docs/guide/changing.md shows, and those of docs/guide/patches, apply to the sources
# as they are. A room with changed files compiles as the build unites it, with the build's warnings;
# of a room with changed headers alone, these do. Then the tests run that a patch brings or changes.
# Usage: patches.sh SOURCE BUILD LIBRARY TEST_MAIN, the last two of the build: the library and the
# object with main() of the tests
set -eu
source=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)
library=$3
test_main=$4
command -v patch >/dev/null || { echo 'no patch here'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# command_of TARGET TREE: the build's compiler and flags for the target, with the sources of TREE. -O0,
# since the tests are small.
command_of() {
  sed -n "s|^ *\"command\": \"\\(.* \\)-o [^ ]*CMakeFiles/$1\\.dir/.*|\\1|p" "$build/compile_commands.json" |
    sed -n "1s#-I$source\\(/src\\|/tests\\|\\) #-I$2\\1 #gp" | sed 's/$/-O0/'
}

# users_of TREE HEADER: the test files that a changed header of the tests concerns.
users_of() { grep -l "\"${2#tests/}\"" "$1/${2%/*}"/*.cpp; }

# check_patch NAME: $work/NAME.patch
check_patch() {
  name=$1
  tree=$work/$name
  mkdir "$tree"
  for folder in src more deliso check io view app tests bench docs; do
    cp -r "$source/$folder" "$tree"
  done
  (cd "$tree" && patch -p1 --fuzz=0 --quiet <"$tree.patch") ||
    { echo "$name: a change does not apply"; return 1; }
  changed=$(sed -n 's|^+++ b/||p' "$tree.patch" | grep '\.\(cpp\|h\)$')
  objects=
  tests=
  for room in $(echo "$changed" | sed 's|/[^/]*$||' | sort -u); do
    own=$(echo "$changed" | grep "^$room/[^/]*$")
    sources=$(echo "$own" | grep '\.cpp$') || true
    target=room_$(echo "$room" | tr / _)
    folders=
    case $room in
      app) target=deliso_cli ;;
      bench) target=room_check folders="-I$tree/bench -I$tree/tests" ;; # each file is a program
      tests/*)
        target=tests_$(echo "${room#tests/}" | tr / _)
        for header in $(echo "$own" | grep '\.h$'); do
          sources="$sources $(users_of "$tree" "$header" | sed "s|^$tree/||")"
        done
        for file in $sources; do tests=$tests,*/${file##*/}; done
        ;;
    esac
    if [ "$room" != bench ] && echo "$own" | grep -q '\.cpp$'; then
      sources=$(cd "$tree" && ls "$room"/*.cpp)
    fi
    for file in ${sources:-$own}; do echo "#include \"$tree/$file\""; done >"$tree/united.cpp"
    command=$(command_of "$target" "$tree")
    [ -n "$command" ] || { echo "$name: the build has no $target"; return 1; }
    $command $folders -c "$tree/united.cpp" -o "$tree/$target-${room##*/}.o" ||
      { echo "$name: $room does not compile"; return 1; }
    [ "$room" = bench ] || objects="$objects $tree/$target-${room##*/}.o"
  done
  if [ -z "$tests" ]; then
    echo "$name: compiles"
    return 0
  fi
  # Rooms that are not compiled here are the build's. They know nothing of the patch, which the tests
  # of the changed rooms do not need.
  ${command%% *} $objects "$test_main" "$library" -pthread -o "$tree/run" ||
    { echo "$name: its tests do not link"; return 1; }
  said=$("$tree/run" "--source-file=${tests#,}") || { echo "$said"; echo "$name: a test fails"; return 1; }
  passed=$(echo "$said" | sed -n 's/.*test cases: *\([0-9]*\) |.*/\1/p')
  [ "$passed" -gt 0 ] || { echo "$name: no test ran"; return 1; }
  echo "$name: compiles, $passed test cases pass"
}

# The page's own changes are the beginning of the proposer.
page=docs/guide/changing.md
awk '/^```diff$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/$page" >"$work/proposer.patch"
grep -q '^+' "$work/proposer.patch" || { echo "$page: shows no change"; exit 1; }
for file in "$source"/docs/guide/patches/*.patch; do
  name=$(basename "$file" .patch)
  grep -q "(patches/$name.patch)" "$source/$page" || { echo "$page: no link to $name.patch"; exit 1; }
  cat "$file" >>"$work/$name.patch"
  check_patch "$name" || exit 1
done

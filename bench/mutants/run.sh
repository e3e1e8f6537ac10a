#!/bin/sh
# SPDX-License-Identifier: MIT
# Do the tests of a primitive find a wrong one? Each patch here is a mutant: one wrong line of the code. Its
# head says what is wrong, whose tests must find it ("Tests: ROOM", a folder of tests/), and, where that cannot be, why
# ("Equivalent:", no test can; "Waits:", not yet). Switches that tests
# judge (bench/switches) are mutants, too. A mutant is made in a copy of the sources: each room that it changes
# is compiled as one file and linked before the library, so that nothing else is built again; for a
# header, the room of its tests and the tests, too.
# Prints a line per mutant, with the test case that caught it. Exit status 1: one survived, is no longer equivalent or no longer waits.
# Usage: run.sh --check                 all patches apply, and their heads are right
#        run.sh BUILD [JOBS] [ROOM...]  BUILD has the library (make mutants ROOM=...)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)

. "$here/../patches.sh"
mutants_of() { (cd "$here" && grep -lx "Tests: $1" *.patch ../switches/*.patch) | sed 's|\.patch$||'; }

if [ "$1" = --check ]; then
  wrong=0
  for name in $(all_patches); do
    ls "$source/tests/$(head_of "$name" Tests)"/test_*.cpp >/dev/null 2>&1 ||
      { echo "$name: no room of tests \"$(head_of "$name" Tests)\""; wrong=1; }
    still_applies "$name" || wrong=1
  done
  echo "$(all_patches | wc -l | tr -d ' ') mutants"
  exit "$wrong"
fi

if [ "$1" != --one ]; then
  build=$(cd "$1" && pwd)
  shift
  jobs=${1:-1}
  [ $# -gt 0 ] && shift
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  trap 'exit 130' INT TERM
  mkdir "$work/outcomes"
  doctest=$(sed -n 's/^DOCTEST_INCLUDE_DIR:PATH=//p' "$build/CMakeCache.txt")
  [ -d "$doctest" ] || doctest=$build/doctest-2.4.11
  compile="${CXX:-c++} -std=c++20 -O1 -w -ffp-contract=off -DDELISO_SOURCE_DIR=\"$source\""
  includes="-I$source/src -I$source -I$build/generated -I$source/tests -idirafter $doctest"
  printed="-include $source/tests/printed.h"
  export build work compile includes printed
  $compile $includes -c "$source/tests/main.cpp" -o "$work/main.o"
  status=0
  rooms=$(for name in $(all_patches); do head_of "$name" Tests; done | sort -u)
  for room in ${*:-$rooms}; do
    mutants=$(mutants_of "$room")
    [ -n "$mutants" ] || { echo "$room: no mutants"; exit 2; }
    # The tests themselves, which must pass on the code as it is; three times as long is too long.
    mkdir -p "$work/$room"
    for file in "$source/tests/$room"/test_*.cpp; do echo "#include \"$file\""; done >"$work/$room/tests.cpp"
    $compile $includes $printed -c "$work/$room/tests.cpp" -o "$work/$room/tests.o"
    ${CXX:-c++} "$work/$room/tests.o" "$work/main.o" "$build/libdeliso.a" -pthread -o "$work/$room/tests"
    started=$(date +%s)
    "$work/$room/tests" >"$work/$room/log" || { tail -n 20 "$work/$room/log"; echo "$room: its tests fail"; exit 2; }
    echo $((3 * ($(date +%s) - started) + 10)) >"$work/$room/limit"
    echo "$mutants" | xargs -P "$jobs" -I{} sh "$0" --one {} "$room" || status=1
  done
  echo
  for word in caught equivalent waits survived 'no longer' 'not compiled'; do
    printf '%-14s %s\n' "$word" "$(cat "$work"/outcomes/* | grep -c "^$word" || true)"
  done
  grep -hv '^caught\|^equivalent\|^waits' "$work"/outcomes/* || [ "$status" = 0 ] || exit 2
  exit "$status"
fi

# One mutant of a room: exit status 1 unless its outcome is that of its head.
name=$2 room=$3
label=${name##*/}
at=$work/$room/$label
mkdir "$at"
for folder in src more deliso check io; do cp -r "$source/$folder" "$at"; done
apply "$name" "$at"
compile="$compile -I$at/src -I$at $includes"

# Compiles the mutant's rooms and links its tests.
build_tests() {
  files=$(sed -n 's|^+++ b/||p' "$here/$name.patch")
  folders=$(for file in $files; do dirname "$file"; done)
  tests=$work/$room/tests.o
  case $files in
    *.h)
      for folder in src/"$room" "$room"; do [ ! -d "$at/$folder" ] || folders="$folders $folder"; done
      tests=$at/tests.o
      $compile $printed -c "$work/$room/tests.cpp" -o "$tests" || return
      ;;
  esac
  objects=
  for folder in $(printf '%s\n' $folders | sort -u); do
    object=$at/$(echo "$folder" | tr / _)
    for file in "$at/$folder"/*.cpp; do [ ! -f "$file" ] || echo "#include \"$file\""; done >"$object.cpp"
    $compile -c "$object.cpp" -o "$object.o" || return
    objects="$objects $object.o"
  done
  ${CXX:-c++} $objects "$tests" "$work/main.o" "$build/libdeliso.a" -pthread -o "$at/tests"
}

outcome=
if build_tests 2>"$at/log"; then
  # A mutant may run for ever, and fill a list meanwhile: 4 GiB are the most.
  found=0
  (ulimit -v 4194304 && timeout "$(cat "$work/$room/limit")" "$at/tests" --abort-after=1 || exit $?) \
    >"$at/log" 2>&1 || found=$?
  # Messages of test cases that passed have such lines, too.
  why=$(sed -n 's/^TEST CASE: *//p' "$at/log" | tail -n 1)
  case $found in
    0) outcome=survived ;;
    124) outcome='caught by the time limit' ;;
    *) outcome="caught by \"$why\"" ;;
  esac
  for key in Equivalent Waits; do
    [ -z "$(head_of "$name" $key)" ] && continue
    word=$(echo $key | tr A-Z a-z)
    case $outcome in
      survived) outcome=$word ;;
      *) outcome="no longer $word: $outcome" ;;
    esac
  done
else
  outcome="not compiled: $(head -n 1 "$at/log")"
fi
rm -rf "$at"
printf '%-10s %-11s %s\n' "$label" "$room" "$outcome"
echo "$outcome ($label)" >"$work/outcomes/$label"
case $outcome in caught* | equivalent | waits) ;; *) exit 1 ;; esac

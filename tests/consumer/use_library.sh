#!/bin/sh
# SPDX-License-Identifier: MIT
# The library in a project of a stranger: installed and found by CMake, by pkg-config where there is
# one, and as a part of the project. The mesh must be the program's, byte for byte, in the world.
# Usage: use_library.sh SOURCE PREFIX ROTATED_NIFTI CXX, after install.sh
set -eu
source=$1
prefix=$2
rotated_nifti=$3
cxx=$4
deliso=$prefix/bin/deliso
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

"$rotated_nifti" "$work/volume.nii"
"$deliso" "$work/volume.nii" --iso 100.1 -q -o "$work/expected.off"
head -n 1 "$work/expected.off"

# The criteria in the comments are the program's alone.
same() {
  grep -v '^#' "$work/expected.off" >"$work/a"
  grep -v '^#' "$1" >"$work/b"
  cmp "$work/a" "$work/b"
}

cmake -S "$source/tests/consumer" -B "$work/found" -DCMAKE_CXX_COMPILER="$cxx" \
  -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
cmake --build "$work/found" | tail -n 1
"$work/found/consumer" "$work/volume.nii" 100.1 "$work/found.off"
same "$work/found.off"

if command -v pkg-config >/dev/null; then
  export PKG_CONFIG_PATH
  PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name deliso.pc)")
  # shellcheck disable=SC2046
  "$cxx" -std=c++20 "$source/tests/consumer/consumer.cpp" -o "$work/by_pkg_config" \
    $(pkg-config --cflags --libs deliso)
  "$work/by_pkg_config" "$work/volume.nii" 100.1 "$work/by_pkg_config.off"
  same "$work/by_pkg_config.off"
else
  echo 'no pkg-config here: its file was not tried'
fi

# The C library, from a program in C.
if command -v cc >/dev/null; then
  libraries=$(dirname "$(find "$prefix" -name libdeliso_c.so)")
  for standard in c89 c99; do
    cc -std=$standard -pedantic-errors -Wall -Wextra -Werror -I"$prefix/include" \
      "$source/tests/consumer/consumer.c" -o "$work/consumer_c" -L"$libraries" -ldeliso_c \
      -Wl,-rpath,"$libraries"
  done
  "$work/consumer_c" "$work/from_c.ply"
  [ -s "$work/from_c.ply" ]
else
  echo 'no C compiler here: the header was not tried in C'
fi

# As a part of another project the headers have the same names; compiling one file shows it.
cmake -G "Unix Makefiles" -S "$source/tests/consumer" -B "$work/part" \
  -DCMAKE_CXX_COMPILER="$cxx" \
  -DDELISO_SOURCE="$source" >/dev/null
make -C "$work/part" consumer.o | tail -n 1
echo 'the same mesh each way'

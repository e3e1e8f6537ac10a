#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the program for WebAssembly: FOLDER/deliso.wasm, a command of WASI (preview 1). Every folder of
# sources is compiled as one file, as in the native build. Needs Debian's packages clang-16 lld-16
# libc++-16-dev-wasm32 libc++abi-16-dev-wasm32 libclang-rt-16-dev-wasm32 wasi-libc.
# Usage: [WASM_CXX=clang++-16] [WASM_LAUNCHER=ccache] build.sh FOLDER [JOBS]
set -eu
cd "$(dirname "$0")/.."
mkdir -p "$1/units" "$1/objects" "$1/generated/base" "$1/generated/view/page"
out=$(realpath "$1")
jobs=${2:-$(nproc)}
compiler=${WASM_CXX:-clang++-16}
libraries=/usr/lib/llvm-16
command -v "$compiler" >/dev/null || {
  echo "make web needs $compiler: docs/guide/browser.md names its packages" >&2
  exit 2
}

compile() {
  # What CMake generates in the native build.
  version=$(sed -n 's/^project(deliso VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
  sed "s/@PROJECT_VERSION@/$version/" cmake/version.h.in >"$out/generated/base/version.h"
  pages=$(ls view/page/web/* | sed "s|^|$PWD/|" | paste -sd ';')
  cmake "-DSOURCES=$pages" "-DOUTPUT=$out/generated/view/page/web_sources.cpp" -DFUNCTION=web_sources \
    -P cmake/embed_web_sources.cmake

  # A unit includes the files of a folder: one file to compile. Large ones come first, so that no
  # processor waits for the last.
  rm -f "$out"/units/* "$out"/objects/*
  for folder in src/* more/* deliso check io/* view/* app web; do
    unit=$out/units/$(echo "$folder" | tr / _).cpp
    for source in "$folder"/*.cpp; do
      case $source in
        */\*.cpp | app/signals.cpp | app/peak_memory.cpp) ;;
        *) echo "#include \"$PWD/$source\"" >>"$unit" ;;
      esac
    done
  done
  echo "#include \"$out/generated/view/page/web_sources.cpp\"" >>"$out/units/view_page.cpp"

  # -isystem: the compiler does not find these folders by itself. Without contraction to fused
  # multiply-add, as in the native build. -Wno-shorten-64-to-32: sizes have 32 bits here, and what does not fit
  # is refused with its file. Messages of broken invariants name sources of the project, not of this machine.
  ls -S "$out/units" | sed 's/\.cpp$//' | xargs -P "$jobs" -I UNIT ${WASM_LAUNCHER:-} "$compiler" --target=wasm32-wasi \
    -isystem web/include -isystem $libraries/include/wasm32-wasi/c++/v1 -isystem /usr/include/wasm32-wasi \
    -D_WASI_EMULATED_GETPID -D_WASI_EMULATED_MMAN -D_WASI_EMULATED_SIGNAL \
    -std=c++20 -O2 -DNDEBUG -fwasm-exceptions -ffp-contract=off -Isrc -I. "-I$out/generated" "-ffile-prefix-map=$PWD/=" \
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wno-shorten-64-to-32 -Werror \
    -c "$out/units/UNIT.cpp" -o "$out/objects/UNIT.o"

  "$compiler" --target=wasm32-wasi -fwasm-exceptions -nostdlib++ -fuse-ld=lld -L/usr/lib/wasm32-wasi \
    -L$libraries/lib/wasm32-wasi "$out"/objects/*.o -lc++ -lc++abi \
    -lwasi-emulated-getpid -lwasi-emulated-mman -lwasi-emulated-signal -Wl,--wrap=close -Wl,--wrap=fstat \
    -Wl,--strip-all -Wl,-z,stack-size=8388608 -Wl,--max-memory=4294967296 -o "$out/deliso.wasm"
}

# A change of any source compiles all of them again, which takes about a minute.
trees='src more deliso check io view app'
if [ ! -f "$out/deliso.wasm" ] ||
    [ -n "$(find $trees web/*.cpp web/include web/build.sh CMakeLists.txt cmake -type f -newer "$out/deliso.wasm")" ]; then
  compile
fi
cp web/npm/deliso.mjs "$out/"

# The page, for any server of files.
mkdir -p "$out/page"
cp web/page/* "$out/deliso.wasm" "$out/page/"

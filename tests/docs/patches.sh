#!/bin/sh
# SPDX-License-Identifier: MIT
# The changes that docs/guide/changing.md shows, and those of docs/guide/patches, apply to the sources
# as they are, and compile.
# Usage: patches.sh SOURCE BUILD [CXX]
set -eu
source=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)
compiler=${3:-c++}
command -v patch >/dev/null || { echo 'no patch here'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# The page's own changes are the beginning of the proposer.
page=docs/guide/changing.md
awk '/^```diff$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$source/$page" >"$work/page.patch"
grep -q '^+' "$work/page.patch" || { echo "$page: shows no change"; exit 1; }

for file in "$source"/docs/guide/patches/*.patch; do
  name=$(basename "$file" .patch)
  mkdir "$work/$name"
  for tree in src io view app tests bench docs; do
    cp -r "$source/$tree" "$work/$name"
  done
  grep -q "(patches/$name.patch)" "$source/$page" || { echo "$page: no link to $name.patch"; exit 1; }
  [ "$name" = proposer ] && cat "$work/page.patch" >"$work/$name.patch"
  cat "$file" >>"$work/$name.patch"
  (cd "$work/$name" && patch -p1 --fuzz=0 --quiet <"$work/$name.patch") ||
    { echo "$name: a change does not apply"; exit 1; }
  changed=$(sed -n 's|^+++ b/||p' "$work/$name.patch")
  for file in $changed; do
    case $file in
      docs/*) continue ;;
      *.cpp | *.h) ;;
      *) continue ;;
    esac
    "$compiler" -std=c++20 -fsyntax-only -w -x c++ \
      -I"$work/$name/src" -I"$work/$name" -I"$build/generated" -I"$work/$name/bench" -I"$work/$name/tests" \
      "$work/$name/$file" || { echo "$name: $file does not compile"; exit 1; }
  done
  echo "$name: $(echo "$changed" | wc -l | tr -d ' ') files"
done

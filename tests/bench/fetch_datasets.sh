#!/bin/sh
# SPDX-License-Identifier: MIT
# bench/fetch_datasets.sh against a list of files on this disk: what is right is kept, what is not is
# named and not kept, and nothing else is left behind. Usage: fetch_datasets.sh SOURCE PROGRAM
set -eu
. "$(dirname "$0")/../holds.sh"
fetch=$1/bench/fetch_datasets.sh
deliso=$2
command -v curl >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sum() {
  sha256sum "$1" | cut -d ' ' -f 1
}

# 8 x 4 x 2 samples rising along x.
mkdir "$work/remote"
for row in 1 2 3 4 5 6 7 8; do printf '\001\010\020\030\040\050\060\070'; done >"$work/remote/good"
echo tampered >"$work/remote/tampered"
row() {
  printf '%s\t%s\t8x4x2\t8x4x2\tuint8\t1 1 4\t5\t%s\tbuiltin:torus:64\t%s\tsomewhere\n' "$@"
}
header='name\tfile\tdims\tfile_dims\ttype\tspacing\tisovalue\tsha256\tanalogue\turl\tsource\n'
good=$(sum "$work/remote/good")
{
  printf '# a comment\n'
  printf "$header"
  row GOOD good.nhdr "$good" "file://$work/remote/good"
  row AGAIN good.nhdr "$good" "file://$work/remote/good"
  row PRIVATE private.nhdr - -
} >"$work/list"

holds "what is public is fetched" sh "$fetch" "$work/list" "$work/data" >"$work/out" 2>"$work/err"
holds "the samples are those" cmp -s "$work/remote/good" "$work/data/good.raw"
holds "without a word of error" [ ! -s "$work/err" ]
holds "what is not public is named" grep -q '^private.raw cannot be fetched (somewhere)' "$work/out"
holds "a file is fetched once" [ "$(grep -c '^good.raw from' "$work/out")" -eq 1 ]
"$deliso" info "$work/data/good.nhdr" >"$work/info"
holds "its header is right" grep -q '8 x 4 x 2 uint8, spacing 1 1 4' "$work/info"
holds "a second time" sh "$fetch" "$work/list" "$work/data" >"$work/out" 2>&1
holds "nothing is fetched" [ "$(grep -c from "$work/out")" -eq 0 ]

{
  printf "$header"
  row TAMPERED tampered.nhdr "$good" "file://$work/remote/tampered"
  row ABSENT absent.nhdr "$good" "file://$work/remote/absent"
  row GOOD good.nhdr "$good" "file://$work/remote/good"
} >"$work/list"
rm -rf "$work/data"
status=0
sh "$fetch" "$work/list" "$work/data" >"$work/out" 2>"$work/err" || status=$?
holds "a wrong checksum and a missing file fail" [ "$status" -eq 1 ]
holds "the wrong checksum is named" grep -q '^tampered.raw was fetched, but its SHA-256' "$work/err"
holds "the missing file is named" grep -q '^absent.raw could not be fetched' "$work/err"
holds "what is right is kept, nothing else" \
  [ "$(ls -A "$work/data" | tr '\n' ' ')" = "good.nhdr good.raw " ]

cp "$work/remote/tampered" "$work/data/good.raw"
status=0
sh "$fetch" "$work/list" "$work/data" >"$work/out" 2>"$work/err" || status=$?
holds "a file that is there and wrong fails" [ "$status" -eq 1 ]
holds "it is named" grep -q '^good.raw is there, but' "$work/err"
holds "and left as it is" cmp -s "$work/remote/tampered" "$work/data/good.raw"

status=0
sh "$fetch" "$work/nothing" "$work/data" >"$work/out" 2>"$work/err" || status=$?
holds "no list is a fault" [ "$status" -ne 0 ]

all_hold 16

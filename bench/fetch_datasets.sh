#!/bin/sh
# SPDX-License-Identifier: MIT
# Fetches the volumes of a list (bench/datasets.tsv) that are public as plain files, each with a NRRD
# header beside it. A file is kept only when its SHA-256 is the list's; what is there already and is
# right is left alone. Exit status 1 when something could not be had that should be.
# Usage: fetch_datasets.sh LIST FOLDER
set -eu
[ $# -eq 2 ] || { echo "usage: $0 LIST FOLDER" >&2; exit 2; }
list=$1
folder=$2
command -v curl >/dev/null || { echo "$0: curl is needed" >&2; exit 2; }

sha256_of() {
  if command -v sha256sum >/dev/null; then sha256sum "$1"; else shasum -a 256 "$1"; fi | cut -d ' ' -f 1
}

mkdir -p "$folder"
work=$(mktemp -d "$folder/.fetch.XXXXXX")
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM

# The columns wanted, by their names, one line per file.
awk -F '\t' -v OFS='\t' '
  /^#/ || /^$/ { next }
  !header { header = 1; for (i = 1; i <= NF; ++i) column[$i] = i; next }
  seen[$column["file"]]++ { next }
  { print $column["file"], $column["file_dims"], $column["type"], $column["spacing"],
          $column["sha256"], $column["url"], $column["source"] }' "$list" >"$work/list"
[ -s "$work/list" ] || { echo "$0: $list lists nothing" >&2; exit 2; }

tab=$(printf '\t')
faults=0
fault() {
  echo "$1" >&2
  faults=$((faults + 1))
}
while IFS=$tab read -r file dims type spacing sha256 url source; do
  raw=${file%.nhdr}.raw
  if [ -e "$folder/$raw" ]; then
    if [ "$sha256" != - ] && [ "$(sha256_of "$folder/$raw")" != "$sha256" ]; then
      fault "$raw is there, but its SHA-256 is not the list's: left as it is"
      continue
    fi
    echo "$raw is there"
  elif [ "$url" = - ]; then
    echo "$raw cannot be fetched ($source): put it and $file there if you have them"
    continue
  else
    echo "$raw from $url"
    if ! curl -fsSL --retry 2 --connect-timeout 20 -o "$work/$raw" "$url" </dev/null; then
      fault "$raw could not be fetched"
      continue
    fi
    found=$(sha256_of "$work/$raw")
    if [ "$sha256" != - ] && [ "$found" != "$sha256" ]; then
      fault "$raw was fetched, but its SHA-256 is $found and not $sha256: not kept"
      rm -f "$work/$raw"
      continue
    fi
    mv "$work/$raw" "$folder/$raw"
  fi
  [ -e "$folder/$file" ] || {
    printf 'NRRD0004\ntype: %s\ndimension: 3\nsizes: %s\nspacings: %s\nendian: little\n' \
      "$type" "$(echo "$dims" | tr x ' ')" "$spacing"
    printf 'encoding: raw\ndata file: %s\n' "$raw"
  } >"$work/$file" && { [ -e "$folder/$file" ] || mv "$work/$file" "$folder/$file"; }
done <"$work/list"
[ "$faults" -eq 0 ]

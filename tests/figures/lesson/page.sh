#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/index.html is what its sources give, and asks nothing of others but its drawings; what it links is
# there.
# Usage: page.sh SOURCE_FOLDER LESSON
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
page=$1/docs/index.html
"$2" "$work/index.html"
cmp "$work/index.html" "$page" || {
  echo 'docs/index.html is another page: make figures writes it'
  exit 1
}
# The name of SVG's elements is no address that is asked for.
sed "s|'http://www.w3.org/2000/svg'||;s|<img src=\"guide/figures/[a-z0-9-]*\.svg\"||" "$page" >"$work/rest"
for outside in http:// https:// 'src=' '<link' '@import' 'url(' 'import(' 'fetch(' XMLHttpRequest WebSocket \
  sendBeacon; do
  if grep -qF -e "$outside" "$work/rest"; then
    echo "docs/index.html has $outside"
    exit 1
  fi
done
grep -q "default-src 'none'" "$page"
# Every picture has its drawing, with words for it.
for picture in $(grep -oE 'data-(picture|solids)="[a-z]*"' "$page" | cut -d '"' -f 2); do
  grep -A 1 "=\"$picture\"" "$page" | grep -q '<img src="guide/figures/.* alt="..........*"' ||
    { echo "no drawing of $picture"; exit 1; }
done
[ "$(grep -c '<figure data-picture=' "$page")" -eq 7 ]
grep -o 'src="[^"]*"' "$page" | cut -d '"' -f 2 | while read -r drawing; do
  test -f "$1/docs/$drawing" || { echo "no $drawing"; exit 1; }
done

#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/index.html is what its sources give, and asks nothing of others but its drawings. Its prices are those
# of docs/results.md. The site has what the page links, or links the repository.
# Usage: page.sh SOURCE_FOLDER LESSON DELISO
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
[ "$(grep -c '<figure.* data-picture=' "$page")" -eq 8 ]
grep -o 'src="[^"]*"' "$page" | cut -d '"' -f 2 | while read -r drawing; do
  test -f "$1/docs/$drawing" || { echo "no $drawing"; exit 1; }
done

# A column of the table of prices, from the two of Table 3.
for volume in FUEL ENGINE; do
  awk -F '|' -v volume=" $volume " '/^\*\*/ { table = $0 }
    table ~ /Table 3: seconds/ && $2 == volume { printf "%.1f µs\n%.1f µs\n", 1e6 * $4, 1e6 * $6 }
    table ~ /Table 3: insertions/ && $2 == volume { printf "%s\n%s\n", $6, $9 }' \
    "$1/docs/results.md" | sed 's/^ *//;s/ *$//' >"$work/prices"
  [ "$(wc -l <"$work/prices")" -eq 4 ]
  while read -r price; do
    grep -q "^<tr>.*<td>$price</td>" "$page" || { echo "$volume: no $price on the page"; exit 1; }
  done <"$work/prices"
done
make -s -C "$1" site SITE="$work/site" DELISO="$3"
links() { grep -o 'href="[^"#]*' "$work/site/index.html" | cut -d '"' -f 2 | grep . | sort -u; }
[ "$(links | wc -l)" -ge 15 ]
for file in $(links) $(grep -o 'src="[^"]*"' "$work/site/index.html" | cut -d '"' -f 2); do
  test -f "$work/site/$file" || { echo "the site has no $file"; exit 1; }
done
if grep -qE 'data-(site|page)' "$work/site/index.html"; then
  echo 'the site hides a link that it has'
  exit 1
fi
make -s -C "$1" site SITE="$work/site" REPOSITORY=https://host/owner/name DELISO="$3"
for link in $(links); do
  test -f "$1/${link#https://host/owner/name/blob/main/}" || test -f "$work/site/$link" || { echo "no $link"; exit 1; }
done

#!/bin/sh
# SPDX-License-Identifier: MIT
# docs/lesson.html is what its sources give, and asks nothing of others.
# Usage: page.sh SOURCE_FOLDER LESSON
set -eu
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
page=$1/docs/lesson.html
"$2" "$work/lesson.html"
cmp "$work/lesson.html" "$page" || {
  echo 'docs/lesson.html is another page: make figures writes it'
  exit 1
}
for outside in http:// https:// 'src=' '<link' '@import' 'url(' 'import(' 'fetch(' XMLHttpRequest WebSocket \
  sendBeacon; do
  # The name of SVG's elements is no address that is asked for.
  if sed "s|'http://www.w3.org/2000/svg'||" "$page" | grep -qF -e "$outside"; then
    echo "docs/lesson.html has $outside"
    exit 1
  fi
done
grep -q "default-src 'none'" "$page"
[ "$(grep -c "^    title: '" "$page")" -eq 6 ]

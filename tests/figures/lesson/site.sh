#!/bin/sh
# SPDX-License-Identifier: MIT
# The site as a phone and a reader of its traces find it. Needs node and Chromium.
# Usage: site.sh SOURCE_FOLDER DELISO
set -eu
command -v node >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# With the page of `make web`, of which two files stand for all, and without.
mkdir -p "$work/web/page"
echo '<!doctype html><title>Try</title>' | tee "$work/web/page/index.html" >"$work/web/page/deliso.wasm"
make -s -C "$1" site SITE="$work/with" DELISO="$2" WEB="$work/web" 2>"$work/told"
[ ! -s "$work/told" ]
cmp "$work/web/page/deliso.wasm" "$work/with/browser/deliso.wasm"
[ "$(grep -c 'href="browser/index.html"' "$work/with/index.html")" -ge 1 ]
make -s -C "$1" site SITE="$work" DELISO="$2" WEB="$work/none" 2>"$work/told"
grep -q '^The site is without the program' "$work/told"
[ ! -e "$work/browser" ]
node "$1/tests/figures/lesson/site.mjs" "$work"

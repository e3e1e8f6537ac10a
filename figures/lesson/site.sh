#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the folder OUT that a static host serves: the page with its drawings, and what the program shows of two
# linked tori in space, two traces and a view. Of these every stop of a trace's tour is there. What the page links of
# the guide is shown by the code host at REPOSITORY (https://host/owner/name); without one the pages lie in OUT, as text.
# Where `make web` has made the folder WEB/page, the site has the program for browsers, and the page runs it.
# Usage: [WEB=FOLDER] site.sh OUT DELISO [REPOSITORY]
set -eu
[ $# -ge 2 ] || { echo "usage: $0 OUT DELISO [REPOSITORY]" >&2; exit 2; }
docs=$(cd "$(dirname "$0")/../../docs" && pwd)
out=$1
deliso=$2
repository=${3:-}
mkdir -p "$out"
"$deliso" trace builtin:linked_tori:16 --paper -o "$out/tori-paper.html" >/dev/null
"$deliso" trace builtin:linked_tori:16 -o "$out/tori.html" >/dev/null
"$deliso" builtin:linked_tori:16 -q -o "$out/tori.ply"
"$deliso" view "$out/tori.ply" -o "$out/tori-mesh.html" >/dev/null
if [ -n "$repository" ]; then
  root=$repository/blob/main/ pages=$repository/blob/main/docs/
else
  root='' pages=''
  cp "$docs/../README.md" "$docs"/*.md "$out/"
  mkdir -p "$out/guide" "$out/course"
  cp "$docs"/guide/*.md "$out/guide/"
  cp "$docs/../course/README.md" "$out/course/"
fi
# Links that the page has on a site only: what they lead to is made here.
sed -E "s|<li hidden data-site>|<li>|;s|data-page=|href=|g;s|href=\"\.\./|href=\"$root|g;s|href=\"([A-Za-z/-]+\.md)|href=\"$pages\1|g" "$docs/index.html" \
  >"$out/index.html"
mkdir -p "$out/guide/figures"
grep -o 'src="[^"]*"' "$docs/index.html" | cut -d '"' -f 2 | while read -r drawing; do
  cp "$docs/$drawing" "$out/$drawing"
done
web=${WEB:-$docs/../build-web}/page
if [ -f "$web/deliso.wasm" ]; then
  mkdir -p "$out/browser"
  cp "$web"/* "$docs/../figures/lesson/site/lesson_program.js" "$out/browser/"
  sed -E "s|<(li\|div) hidden data-program>|<\\1>|;s|data-program-page=|href=|
    s|<!-- program -->|<script type=\"module\" src=\"browser/lesson_program.js\"></script>|
    s|script-src 'unsafe-inline'|script-src 'self' 'unsafe-inline' 'wasm-unsafe-eval'; worker-src 'self'; connect-src 'self'|" \
    "$out/index.html" >"$out/page"
  mv "$out/page" "$out/index.html"
else
  echo 'The site is without the program in the browser, which make web builds.' >&2
fi
touch "$out/.nojekyll"

#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the folder OUT that a static host serves: the page with its drawings, and what the program shows of two
# linked tori in space, two traces and a view. Of these every stop of a trace's tour is there. What the page links of the guide is shown by the code host at
# REPOSITORY (https://host/owner/name); without one, or if it is empty, the pages lie in OUT, as text. The page
# that `make web` built is in the folder BROWSER; it becomes OUT/try, with a link, if it is there.
# Usage: site.sh OUT DELISO [REPOSITORY [BROWSER]]
set -eu
[ $# -ge 2 ] || { echo "usage: $0 OUT DELISO [REPOSITORY [BROWSER]]" >&2; exit 2; }
docs=$(cd "$(dirname "$0")/../../docs" && pwd)
out=$1
deliso=$2
repository=${3:-}
browser=${4:-}
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
if [ -f "$browser/deliso.wasm" ]; then
  mkdir -p "$out/try"
  cp "$browser"/* "$out/try/"
  # The first of the links beyond the page is to it.
  awk '!done && sub(/<li><a href="tori-paper.html">/, "<li><a href=\"try/index.html\">Try it in the browser</a></li>\n&") { done = 1 }
    { print }' "$out/index.html" >"$out/index.new"
  mv "$out/index.new" "$out/index.html"
  grep -q 'href="try/index.html"' "$out/index.html" || { echo "$0: docs/index.html has no place for try/" >&2; exit 1; }
else
  echo 'The site is without try/, the program in the browser, which make web builds.' >&2
fi
mkdir -p "$out/guide/figures"
grep -o 'src="[^"]*"' "$docs/index.html" | cut -d '"' -f 2 | while read -r drawing; do
  cp "$docs/$drawing" "$out/$drawing"
done
touch "$out/.nojekyll"

#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the folder OUT that a static host serves: the page with its drawings. What it links of the guide is
# shown by the code host at REPOSITORY (https://host/owner/name); without one the pages lie in OUT, as text.
# Usage: site.sh OUT [REPOSITORY]
set -eu
[ $# -ge 1 ] || { echo "usage: $0 OUT [REPOSITORY]" >&2; exit 2; }
docs=$(cd "$(dirname "$0")/../../docs" && pwd)
out=$1
repository=${2:-}
mkdir -p "$out"
if [ -n "$repository" ]; then
  readme=$repository/blob/main/README.md pages=$repository/blob/main/docs/
else
  readme=README.md pages=
  cp "$docs/../README.md" "$docs"/*.md "$out/"
  mkdir -p "$out/guide"
  cp "$docs"/guide/*.md "$out/guide/"
fi
sed -E "s|href=\"\.\./README\.md|href=\"$readme|g;s|href=\"([A-Za-z/-]+\.md)|href=\"$pages\1|g" "$docs/index.html" \
  >"$out/index.html"
mkdir -p "$out/guide/figures"
grep -o 'src="[^"]*"' "$docs/index.html" | cut -d '"' -f 2 | while read -r drawing; do
  cp "$docs/$drawing" "$out/$drawing"
done
touch "$out/.nojekyll"

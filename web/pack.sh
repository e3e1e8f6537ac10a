#!/bin/sh
# SPDX-License-Identifier: MIT
# The package for npm, from the program that `make web` built: FOLDER/deliso-VERSION.tgz. With npm it is
# then installed into an empty folder and run. Usage: pack.sh FOLDER
set -eu
cd "$(dirname "$0")/.."
out=$(realpath "$1")
package=$out/package
rm -rf "$package" && mkdir "$package"
cp "$out/deliso.wasm" web/npm/deliso.mjs web/npm/README.md LICENSE "$package"
version=$(sed -n 's/^project(deliso VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
sed "s/@PROJECT_VERSION@/$version/" web/npm/package.json >"$package/package.json"
# An npm package is an archive of a folder of this name. Without dates and owners, the same files make
# the same bytes.
archive=$out/deliso-$version.tgz
tar --sort=name --owner=0 --group=0 --numeric-owner --mtime=@0 -C "$out" -c package | gzip -n9 >"$archive"

command -v npm >/dev/null || { echo "wrote $archive; without npm it is not tried"; exit 0; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# npm's own archive of the folder has the same files.
(cd "$work" && npm pack --silent --offline "$package" >/dev/null && tar -tzf ./*.tgz | sort >own)
tar -tzf "$archive" | grep -v '/$' | sort | cmp - "$work/own"
cd "$work"
export npm_config_cache="$work/cache" npm_config_update_notifier=false
npm install --silent --offline --no-audit --no-fund "$archive"
# Relative and absolute paths, streams, and the exit status, from a folder within.
mkdir data && cd data
npx --offline deliso builtin:torus:24 -q -o ../torus.ply
npx --offline deliso view "$work/torus.ply" -q -o - >torus.html
npx --offline deliso check - builtin:torus:24 <../torus.ply >checked
grep -q '^verdict' checked && grep -q '</html>' torus.html
status=0
npx --offline deliso missing.nrrd 2>said || status=$?
[ "$status" = 2 ] && [ "$(cat said)" = "deliso: $(sed 's/^deliso: //' said)" ] && [ "$(wc -l <said)" = 1 ]
echo "wrote $archive, $(wc -c <"$archive") bytes; it installs and runs"

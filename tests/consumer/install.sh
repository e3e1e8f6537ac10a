#!/bin/sh
# SPDX-License-Identifier: MIT
# Installs what was built into PREFIX, for the tests that are strangers to the source.
# Usage: install.sh BUILD PREFIX
set -eu
rm -rf "$2"
cmake --install "$1" --prefix "$2" >/dev/null
loose=$(grep -rhE '^ *# *include "' "$2/include" | grep -v '"deliso/' || :)
[ -z "$loose" ] || { echo "includes that are not under deliso/: $loose"; exit 1; }
for file in man/man1/deliso.1 bash-completion/completions/deliso zsh/site-functions/_deliso \
  deliso/report.schema.json; do
  [ -s "$2/share/$file" ] || { echo "no $file"; exit 1; }
done
[ "$(ls "$2/include")" = deliso ]

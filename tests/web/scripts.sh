#!/bin/sh
# SPDX-License-Identifier: MIT
# The scripts of the browser's page and of the package for npm: their syntax, and tests of what they compute.
# Needs node. Usage: scripts.sh SOURCE_FOLDER
set -eu
command -v node >/dev/null || exit 77
for script in "$1"/web/npm/*.mjs "$1"/tests/web/*.mjs; do
  node --check "$script"
done
exec node "$1/tests/web/scripts.mjs" "$1"

#!/bin/sh
# SPDX-License-Identifier: MIT
# The site as a phone and a reader of its traces find it. Needs node and Chromium.
# Usage: site.sh SOURCE_FOLDER DELISO
set -eu
command -v node >/dev/null || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
make -s -C "$1" site SITE="$work" DELISO="$2"
node "$1/tests/figures/lesson/site.mjs" "$work"

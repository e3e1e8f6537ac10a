#!/bin/sh
# SPDX-License-Identifier: MIT
# The scripts of the lesson: their syntax, and tests of what they compute. Needs node.
# Usage: scripts.sh SOURCE_FOLDER
set -eu
command -v node >/dev/null || exit 77
for script in "$1"/figures/lesson/web/*.js "$1"/figures/lesson/site/*.js; do
  node --check "$script"
done
exec node "$1/tests/view/page/run_web_tests.js" "$1" figures/lesson/web/lesson.html \
  tests/figures/lesson/test_lesson.js 20

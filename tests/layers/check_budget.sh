#!/bin/sh
# SPDX-License-Identifier: MIT
# The code of each tree stays within its budget (budget.txt). Usage: check_budget.sh PROJECT [BUDGET]
set -eu
budget=$(realpath "${2:-$1/tests/layers/budget.txt}")
cd "$1"

# Prints the lines of code of the folders, in C++ and Python. Standard headers have no ending.
lines() {
  find "$@" -name '*.h' -o -name '*.cpp' -o -name '*.py' -o -path 'web/include/*' -type f | sort | xargs awk '
    { sub(/^[ \t]+/, "") }
    FILENAME ~ /\.py$/ && /^#/ { next }
    /^\/\*/ { comment = 1 }
    comment { if (/\*\//) comment = 0; next }
    !/^$/ && !/^\/\// { ++code }
    END { print code + 0 }'
}

faults=0
all=0
while read -r tree most aim released folders; do
  case $tree in '#' | '') continue ;; esac
  # shellcheck disable=SC2086
  now=$(lines $folders)
  if [ "$tree" = tests ]; then now=$((100 * now / all)); else all=$((all + now)); fi
  grown=$((now - released))
  printf '%-7s %6d of %6d, aim %6d, %+d since the release\n' "$tree" "$now" "$most" "$aim" "$grown"
  if [ "$now" -gt "$most" ]; then
    echo "$tree: over its budget by $((now - most)), grown by $grown since the release"
    faults=$((faults + 1))
  fi
done <"$budget"
[ "$all" -ge 10000 ] && [ "$faults" -eq 0 ]

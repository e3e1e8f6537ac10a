#!/bin/sh
# SPDX-License-Identifier: MIT
# The faulty page has exactly the faults that it says it has. Usage: as run_blocks.sh
set -eu
found=$(sh "$(dirname "$0")/run_blocks.sh" "$@") && { echo 'no faults'; exit 1; }
wanted=$(sed -n 's/.*fault in line \([0-9]*\)\..*/\1/p' "$1" | sort -n)
got=$(echo "$found" | sed -n 's/^FAULT: [^:]*:\([0-9]*\):.*/\1/p' | sort -n)
echo "$found"
[ "$(echo "$wanted" | wc -l)" -ge 10 ] && [ "$got" = "$wanted" ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# The gauntlet on three volumes, by DelIso and by tools that are wrong on purpose: each is scored as what
# it is, a crash ends nothing, and the page gets the tables. Usage: gauntlet.sh SOURCE BUILD
set -eu
. "$(dirname "$0")/../holds.sh"
source=$(realpath "$1")
build=$(realpath "$2")
python=$(for p in python3 /usr/bin/python3; do "$p" -c 'import numpy' 2>/dev/null && echo "$p" && break; done) ||
  { echo 'no Python with NumPy here: the gauntlet was not tried'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat >"$work/tools.py" <<'END'
import os
import sys
import numpy as np
sys.path.append(os.environ["GAUNTLET"])
from tools import Tool

def tetrahedron(at):
    return np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]) * 0.4 + at
SIDES = np.array([[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
def there():
    return "1"
def crossed(volume):
    return np.vstack([tetrahedron(0.2), tetrahedron(0.3)]), np.vstack([SIDES, SIDES + 4])
def fan(volume):
    return tetrahedron(0.2), np.vstack([SIDES, [[0, 1, 2]]])
def opened(volume):
    return tetrahedron(0.2), SIDES[1:]
def crash(volume):
    os.abort()

MESH = "{build}/deliso {volume} --iso {iso} -q -o {mesh}"
TOOLS = [Tool("right", "{build}/deliso --version", MESH), Tool("absent", "no_such_mesher", MESH),
         Tool("closed", "{build}/deliso --version", MESH, closed_only=True),
         Tool("largest", there, MESH + " --largest 1"), Tool("crossed", there, crossed),
         Tool("fan", there, fan), Tool("opened", there, opened), Tool("crash", there, crash)]
END
printf '%s\n' before '<!--gauntlet: made by make gauntlet-->' old '<!--gauntlet: end-->' after >"$work/page.md"
GAUNTLET=$source/bench/gauntlet "$python" -B "$source/bench/gauntlet/gauntlet.py" "$build" "$work/out" \
  --count 3 --first-seed 7 --jobs 2 --tools "$work/tools.py" --page "$work/page.md" >"$work/told" 2>"$work/err"

# row NAME BEGIN: the row of the tool begins so: volumes, exact, exact without ties, manifold, closed,
# crossing, pairs.
row() {
  grep -q "^| $1 [0-9.]* | $2 |" "$work/told" || { grep "^| $1 " "$work/told"; false; }
}
holds 'DelIso is right' row right '3 | 100.0 | 100.0 | 100.0 | 100.0 | 0.0 | 0'
holds 'closed surfaces alone' row closed '1 | 100.0 | 100.0 | 100.0 | 100.0 | 0.0 | 0'
holds 'missing components are no exact topology' row largest '3 | 0.0 | 0.0 | 100.0 | 33.3 | 0.0 | 0'
holds 'crossings are counted' row crossed '3 | 0.0 | 0.0 | 100.0 | 33.3 | 100.0 | [1-9][0-9]*'
holds 'a third triangle at an edge is no manifold' row fan '3 | 0.0 | 0.0 | 0.0 | .*'
holds 'a hole is a hole' row opened '3 | 0.0 | 0.0 | 100.0 | 0.0 | 0.0 | 0'
holds 'a crash is no mesh' row crash '3 | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0'
holds 'what is not there is named' grep -q '^absent: not there$' "$work/err"
holds 'a failure is kept' cmp -s "$work/out/volumes/7.nrrd" "$work/out/failures/crash-no_mesh.nrrd"
tables=2
# by_index NAME BEGIN: the same of the second judge, where CGAL is: exact, manifold, closed, meeting
# itself; meshes that one judge alone calls exact. Rows of one table have other numbers of columns.
by_index() {
  grep -q "^| $1 | $2 |$" "$work/told" || { grep "^| $1 " "$work/told"; false; }
}
if [ -x "$build/bench/gauntlet_judge" ]; then
  tables=3
  holds 'DelIso is right by index' by_index right '100.0 | 100.0 | 100.0 | 0.0 | 0, 0'
  holds 'missing components are no exact topology by index' by_index largest '0.0 | 100.0 | 100.0 | 0.0 | 0, 0'
  holds 'crossings meet, and numbers may be right in all' by_index crossed '33.3 | 100.0 | 100.0 | 100.0 | 0, 1'
  holds 'a fan is no manifold by index' by_index fan '0.0 | 0.0 | 0.0 | 100.0 | 0, 0'
  holds 'a hole is a hole by index' by_index opened '0.0 | 100.0 | 0.0 | 0.0 | 0, 0'
  holds 'no mesh is none by index' by_index crash '0.0 | 0.0 | 0.0 | 0.0 | 0, 0'
else
  echo 'no CGAL here: the second judge was not tried'
fi
holds 'the page has the tables' [ "$(grep -c '^| right' "$work/page.md")" -eq $tables ]
holds 'and keeps the rest' [ "$(sed -n '1p;$p' "$work/page.md" | tr '\n' ' ')" = 'before after ' ]
all_hold $((tables == 3 ? 17 : 11))

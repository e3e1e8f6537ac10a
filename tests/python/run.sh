#!/bin/sh
# SPDX-License-Identifier: MIT
# The Python package with the library that was built: the wheel, its tests, and what
# the README and two pages of the guide show. Usage: run.sh SOURCE LIBRARY PROGRAM
set -eu
python=
for candidate in python3 /usr/bin/python3; do
  if "$candidate" -c 'import numpy' 2>/dev/null; then
    python=$candidate
    break
  fi
done
[ -n "$python" ] || { echo 'no Python with NumPy here: the package was not tried'; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export PYTHONDONTWRITEBYTECODE=1

# The wheel holds all that the tests and the pages' programs need.
"$python" - "$1" "$2" "$work" <<'END'
import sys, zipfile
source, library, work = sys.argv[1:]
sys.path.insert(0, source + "/python")
import deliso_wheel
wheel = deliso_wheel.build_wheel(work, {"library": library})
zipfile.ZipFile(f"{work}/{wheel}").extractall(work + "/installed")
END
if "$python" -m pip --version >/dev/null 2>&1; then
  "$python" -m pip install --quiet --no-index --no-deps --no-compile --target "$work/by_pip" "$work"/*.whl
  diff -r "$work/installed/deliso" "$work/by_pip/deliso"
fi
for test in test_deliso test_parts test_solids; do
  PYTHONPATH=$work/installed "$python" "$1/tests/python/$test.py" "$3"
done
# docs/guide/solve.md: its commands print what it shows, and draw its pictures.
if "$python" -c 'import scipy' 2>/dev/null; then
  for kind in sh text; do
    awk -v fence="\`\`\`$kind" '/^```/ { shows = !shows && ours && $0 == fence; ours = 0; next }
                                /^<!-- run by/ { ours = 1 }
                                shows' "$1/docs/guide/solve.md" >"$work/solve.$kind"
  done
  ln -s "$1/examples" "$work/examples"
  python3() { PYTHONPATH=$work/installed command "$python" "$@"; }
  # shellcheck disable=SC1091
  (cd "$work" && . ./solve.sh) | diff - "$work/solve.text"
  for picture in solve foam; do cmp "$work/$picture.svg" "$1/docs/guide/figures/$picture.svg"; done
  [ "$(grep -acE '<PointData>.*"displacement".*<CellData>.*"von Mises"' "$work/foam.vtu")" = 1 ]
  echo 'docs/guide/solve.md: run'
fi
for page in README.md docs/guide/python.md; do
  awk '/^```/ { runs = !runs && /^```python$/ && !skips; skips = 0; next }
       /^<!-- not run/ { skips = 1 }
       runs' "$1/$page" >"$work/page.py"
  [ -s "$work/page.py" ]
  (cd "$work" && PYTHONPATH=$work/installed "$python" page.py)
  echo "$page: run"
done

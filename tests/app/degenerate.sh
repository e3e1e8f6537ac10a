#!/bin/sh
# SPDX-License-Identifier: MIT
# Makes the volumes of docs/degenerate-data.md, runs every command that stands there, and holds the
# answer against the line below the command. Usage: degenerate.sh PROGRAM [PAGE]
set -eu
deliso=$1
page=${2:-$(dirname "$0")/../../docs/degenerate-data.md}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$page" "$work/page.md"
cd "$work"

# volume NAME TYPE "SIZES" "SPACINGS" EXPRESSION: samples as awk computes them from i, j, k.
volume() {
  {
    printf 'NRRD0004\ntype: %s\ndimension: 3\nsizes: %s\nspacings: %s\n' "$2" "$3" "$4"
    printf 'encoding: ascii\n\n'
    echo "$3" | awk "{ for (k = 0; k < \$3; k++) for (j = 0; j < \$2; j++) for (i = 0; i < \$1; i++)
      { d = sqrt((i-4)^2 + (j-4)^2 + (k-4)^2); print $5 } }"
  } >"$1.nrrd"
}
unit="1 1 1"
cube="9 9 9"
volume sample uint8 "$cube" "$unit" '(d == 0 ? 10 : 0)'
volume face uint8 "$cube" "$unit" '(i == 4 && (j == 4 || j == 5) && (k == 4 || k == 5) ? 10 : 0)'
volume voxel uint8 "$cube" "$unit" '(int(i/2) == 2 && int(j/2) == 2 && int(k/2) == 2 ? 10 : 0)'
volume plateau uint8 "$cube" "$unit" '(d < 2.5 ? 20 : d < 3.6 ? 10 : 0)'
volume sheet uint8 "$cube" "$unit" '(k == 4 ? 10 : 0)'
volume gap uint8 "$cube" "$unit" '(k == 4 ? 0 : 10)'
volume touching uint8 "$cube" "$unit" '(i < 4 && j < 4 && k < 4 || i > 4 && j > 4 && k > 4 ? 20 : d == 0 ? 10 : 0)'
volume checkerboard uint8 "4 4 3" "$unit" '((i + j + k) % 2 == 0 ? 95 : 176)'
volume two uint8 "9 9 2" "$unit" 'int(40 - 10 * sqrt((i-4)^2 + (j-4)^2) + 5 * k + 20)'
volume one uint8 "9 9 1" "$unit" 'i'
volume constant uint8 "$cube" "$unit" '7'
volume on_box uint8 "$cube" "$unit" '(k == 0 ? 10 : 0)'
volume outside_box uint8 "$cube" "$unit" '(k == 0 ? 10 : 20)'
volume long uint8 "$cube" "1 1 20" '(d < 5 ? int(200 - 40 * d) : 0)'
volume huge float "$cube" "$unit" '(d < 2.9 ? "1e30" : "-1e30")'
volume large double "$cube" "$unit" '(d < 2.9 ? "1e75" : "-1e75")'
volume too_large double "$cube" "$unit" '(d < 2.9 ? "5e307" : "-5e307")'
volume denormal double "$cube" "$unit" 'sprintf("%de-310", 30 - 10 * d)'
volume denormal_float float "$cube" "$unit" 'sprintf("%de-43", 30 - 10 * d)'
volume full_range uint16 "$cube" "$unit" '(d < 1.5 ? 65535 : d < 3.9 ? int(65535 - 13000 * d) : 0)'
volume negative int16 "$cube" "$unit" '(d < 1.5 ? 32767 : d < 3.9 ? int(9000 - 10000 * d) : -32768)'

# Whether the output has the answer; a mesh also has the exact topology, by the program's own word.
holds() {
  grep -q -F -e "$answer" output || return 1
  case $answer in *Euler*) grep -q '^exact     the same' output ;; esac
}

commands=0
faults=0
sed -n '/^\$ deliso /{s/^\$ deliso //;p;n;p}' page.md >pairs
while read -r command && read -r answer; do
  commands=$((commands + 1))
  status=0
  # shellcheck disable=SC2086
  "$deliso" $command >output 2>&1 </dev/null || status=$?
  wanted=0
  case $answer in "exit "[12]": "*)
    wanted=${answer#exit }
    wanted=${wanted%%:*}
    answer=${answer#exit ?: }
    ;;
  esac
  if [ "$status" -ne "$wanted" ] || ! holds; then
    faults=$((faults + 1))
    echo "FAULT: deliso $command"
    echo "  wanted: exit $wanted, $answer"
    echo "  got: exit $status"
    sed 's/^/  | /' output
  fi
done <pairs

echo "$commands commands, $faults faults"
[ "$commands" -ge 20 ] && [ "$faults" -eq 0 ]

#!/bin/sh
# SPDX-License-Identifier: MIT
# The counts in Tables 2 to 4 and in "How early" of docs/results.md are those of this program, for the volumes at hand: counts
# are the same on any machine. After a change `make tables DATA=folder` makes the page anew.
# Usage: results.sh SOURCE PROGRAM, with DELISO_DATA=folder of volumes
set -eu
source=$1
deliso=$2
[ -n "${DELISO_DATA:-}" ] || exit 77
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# cell TABLE VOLUME COLUMN: of the table under the title that begins so.
cell() {
  awk -F'|' -v title="$1" -v volume="$2" -v column="$3" '
    index($0, "**" title) == 1 { inside = 1; next }
    inside && /^[#*]/ { exit }
    inside { name = $2; gsub(/ /, "", name)
             if (name == volume) { value = $(column + 1); gsub(/[ ,]/, "", value); print value; exit } }
  ' "$source/docs/results.md"
}

faults=0
seen=0
# told WHAT VALUE TABLE VOLUME COLUMN
told() {
  stands=$(cell "$3" "$4" "$5")
  [ "$2" = "$stands" ] || { echo "docs/results.md: $4: $1 is $2, the page has '$stands'"; faults=1; }
}
grep -v '^#' "$source/bench/datasets.tsv" | tail -n +2 | cut -f 1,2,7 >"$work/volumes"
while read -r name file isovalue; do
  [ -f "$DELISO_DATA/$file" ] || continue
  [ -n "$(cell 'Table 3' "$name" 1)" ] || continue
  seen=$((seen + 1))
  "$deliso" "$DELISO_DATA/$file" --iso "$isovalue" --paper --verbose -o "$work/mesh.ply" | tr -d , >"$work/told"
  # stage seconds points us/point searches/p CPI CPI*
  read -r n_rc cpi_rc cpi_rc_hit n_rf cpi_rf cpi_rf_hit vertices components euler <<END
$(awk '$1 == "initial" { initial = $3 } $1 == "recover" { printf "%d %s %s ", initial + $3, $6, $7 }
       $1 == "refine" { printf "%s %s %s ", $3, $6, $7 } $1 == "mesh" { printf "%s ", $2; getline; print $1, $5 }' "$work/told")
END
  told n_RC "$n_rc" 'Table 3' "$name" 5
  told n_RF "$n_rf" 'Table 3' "$name" 9
  told vertices "$vertices" 'Table 2' "$name" 11
  told components "$components" 'How early' "$name" 3
  told 'the Euler number' "$euler" 'How early' "$name" 5
  told vertices "$vertices" 'How early' "$name" 7
  told CPI_RC "$cpi_rc" 'Table 4' "$name" 3
  told 'CPI*_RC' "$cpi_rc_hit" 'Table 4' "$name" 5
  told CPI_RF "$cpi_rf" 'Table 4' "$name" 7
  told 'CPI*_RF' "$cpi_rf_hit" 'Table 4' "$name" 9
done <"$work/volumes"
echo "$seen volumes"
[ "$seen" -gt 0 ] || faults=1
exit "$faults"

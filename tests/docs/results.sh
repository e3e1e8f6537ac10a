#!/bin/sh
# SPDX-License-Identifier: MIT
# The counts in Tables 2 to 5 of docs/results.md, of points at the switch, and in its table of built-in
# fields, are those of this program: counts are the same on any machine. After a change `make tables DATA=folder` makes the page
# anew. What sentences say of columns, from the least to the largest, is so (builtin).
# Usage: results.sh builtin|volumes SOURCE PROGRAM
#   volumes: those in DELISO_DATA; 77 without that
set -eu
which=$1
source=$2
deliso=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# cell TABLE ROW COLUMN: of the table under the title that begins so; columns that have one name are
# told apart by a number, as in "ratio 2".
cell() {
  awk -F ' *[|] *' -v title="**$1" -v row="$2" -v column="$3" '
    index($0, title) == 1 { inside = 1; next }
    inside && /^[#*]/ { exit }
    inside && /^[|]/ && !header { header = 1
      for (n = 2; n < NF; n++) { name = $n; if (++seen[name] > 1) name = name " " seen[$n]; at[name] = n }
      next }
    inside && $2 == row { value = $(at[column]); gsub(/,/, "", value); print value; exit }
  ' "$source/docs/results.md"
}

faults=0
seen=0
# told VALUE TABLE ROW COLUMN
told() {
  stands=$(cell "$2" "$3" "$4")
  [ "$1" = "$stands" ] || { echo "docs/results.md: $3: $4 is $1, '$2' has '$stands'"; faults=1; }
}

# run INPUT ISOVALUE LINES [OPTION...]: sets the counts of a run.
run() {
  input=$1
  level=$2
  lines_of_run=$3
  shift 3
  "$deliso" "$input" --iso "$level" --paper --lines "$lines_of_run" "$@" --verbose -o "$work/mesh.ply" |
    tr -d , >"$work/told"
  # stage seconds points us/point searches/p CPI CPI*
  read -r s_0 n_rc cpi_rc cpi_rc_hit n_rf cpi_rf cpi_rf_hit vertices triangles components euler <<END
$(awk '$1 == "initial" { printf "%s ", $3 } $1 == "recover" || $1 == "refine" { printf "%s %s %s ", $3, $6, $7 }
       $1 == "mesh" { printf "%s %s ", $2, $4; getline; print $1, $5 }' "$work/told")
END
  seen=$((seen + 1))
}
told_insertions() {
  told "$s_0" "$1" "$2" S₀
  told "$n_rc" "$1" "$2" n_RC
  told "$n_rf" "$1" "$2" n_RF
}
# told_switch ROW POINTS COMPONENTS: by their columns.
told_switch() {
  told "$((s_0 + n_rc))" 'Points at the switch' "$1" "$2"
  told "$components" 'Points at the switch' "$1" "$3"
}
told_searches() {
  told "$cpi_rc" "$1" "$2" CPI_RC
  told "$cpi_rc_hit" "$1" "$2" 'CPI*_RC'
  told "$cpi_rf" "$1" "$2" CPI_RF
  told "$cpi_rf_hit" "$1" "$2" 'CPI*_RF'
}

# column TITLE COLUMN: of the eight pairs, a line each, the least first.
column() {
  for name in FUEL ATOM ENGINE LEG TOOTH BABY1 BABY2 ANEURISM; do cell "$1" "$name" "$2"; done | sort -n
}
# from_to FORMAT: of the first and the last of the lines that are read.
from_to() { awk -v format="$1" 'NR == 1 { least = $1 } END { printf format, least, $1 }'; }
# says PAGE WORDS
says() {
  tr -s ' \n' '  ' <"$source/$1" | grep -qF -e "$2" || { echo "$1: does not say '$2'"; faults=1; }
}

if [ "$which" = builtin ]; then
  says docs/results.md "| $(column 'Table 2' speedup | from_to '%.1f to %.1f times') |"
  says docs/results.md "| $(column 'Table 3: seconds' t_RC/t_RF | from_to '%.0f to %.0f times'), though"
  says docs/results.md "| $(column 'Table 5' 'restricted, %' | from_to '%.2f to %g %%') ("
  exact=$(column 'Points at the switch' right | grep -cx 5)
  says README.md "of eight volumes $(echo one two three four five six seven | cut -d ' ' -f "$exact") come out exact"
  says README.md "takes $(sed -n '/^## Beside other/,/^## A given/p' "$source/docs/performance.md" |
    sed -n 's/^| [A-Z].* | \([0-9.]*\); .* | .* |$/\1/p' | sort -n | from_to '%s to %s') times as long"
  fields='Built-in fields'
  for field in builtin:fuel:64 builtin:orbital:64; do
    run "$field" "$(cell "$fields" "$field" isovalue)" 50
    told_insertions "$fields" "$field"
    told_searches "$fields" "$field"
    told "$vertices" "$fields" "$field" vertices
    told "$components" "$fields" "$field" components
    told "$euler" "$fields" "$field" 'Euler number'
  done
else
  [ -n "${DELISO_DATA:-}" ] || exit 77
  grep -v '^#' "$source/bench/datasets.tsv" | tail -n +2 | cut -f 1,2,7,8 >"$work/volumes"
  while read -r name file isovalue lines; do
    [ -f "$DELISO_DATA/$file" ] || continue
    [ -n "$(cell 'Table 3: insertions' "$name" n_RC)" ] || continue
    run "$DELISO_DATA/$file" "$isovalue" "$lines"
    told "$lines" 'Table 3: insertions' "$name" lines
    told_insertions 'Table 3: insertions' "$name"
    told_searches 'Table 4' "$name"
    told "$triangles" 'Table 5' "$name" triangles
    told "$components" 'Table 5' "$name" components
    told "$euler" 'Table 5' "$name" 'Euler number'
    told_switch "$name" published components
    run "$DELISO_DATA/$file" "$isovalue" "$lines" --stop-after stage1 --facet-cycles
    told_switch "$name" 'facet cycles' 'components 2'
    run "$DELISO_DATA/$file" "$isovalue" "$lines" --stop-after stage1 --certified
    told_switch "$name" certified 'components 3'
    run "$DELISO_DATA/$file" "$isovalue" "$lines" --stop-after stage1 --certified --eps 0.2
    told_switch "$name" 'certified, eps' 'components 4'
  done <"$work/volumes"
fi
echo "$seen compared"
[ "$seen" -gt 0 ] || faults=1
exit "$faults"

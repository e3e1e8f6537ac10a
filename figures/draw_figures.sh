#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the paper's figures that show meshes, OUT/figure-*.png, and the picture of the README,
# OUT/fuel.png; writes OUT/README.md, which says of each what it shows and by which commands: those
# that need no data are run by a test. Where a data set is missing its built-in analogue is drawn,
# under a name that says so. Nothing in OUT changes unless all of it succeeded.
# Usage: draw_figures.sh BUILD OUT [DATA]
set -eu
[ $# -ge 2 ] || { echo "usage: $0 BUILD OUT [DATA]" >&2; exit 2; }
mkdir -p "$2"
build=$(cd "$1" && pwd)
out=$(cd "$2" && pwd)
# Without a third argument DELISO_DATA counts, as for the tables.
data=${3:-${DELISO_DATA:-}}
case $data in ''|/*) ;; *) data=$PWD/$data ;; esac
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
trap 'exit 130' INT TERM
mkdir "$work/meshes" "$work/pictures"
cd "$work/meshes"

shown='ATOM,FUEL,ENGINE,LEG,TOOTH,CHEST,BABY1,BABY2'
"$build/bench/list_datasets" --data "$data" --only $shown >"$work/datasets"
of_dataset() { awk -F '\t' -v name="$1" -v n="$2" '$1 == name { print $n }' "$work/datasets"; }
is_analogue() { case $(of_dataset "$1" 2) in builtin:*) ;; *) return 1 ;; esac; }

# 12345 -> 12,345
grouped() {
  echo "$1" | awk '{ while (length($1) > 3) { tail = "," substr($1, length($1) - 2) tail
                                              $1 = substr($1, 1, length($1) - 3) } print $1 tail }'
}
# How many the PLY file $1 has of element $2.
count_of() { LC_ALL=C sed -n "s/^element $2 //p;/^end_header/q" "$1"; }

# section TITLE [DATASET...]: begins a figure that shows these data sets.
section() {
  panels='' commands='' counts='' remarks='' missing='' checks=''
  title=$1
  shift
  for dataset; do
    case $(of_dataset "$dataset" 4) in
      "paper's") ;;
      builtin:*) remarks="$remarks **$dataset is not at hand: $(of_dataset "$dataset" 2) stands in for it.**" ;;
      *) remarks="$remarks $dataset has $(of_dataset "$dataset" 4) samples here." ;;
    esac
  done
}

# panel FILE INPUT ISOVALUE [OPTION...]: meshes, unless a figure above has done it, and adds a panel. A
# name *cubes.ply is for the mesh of Marching Cubes.
panel() {
  file=$1 input=$2 isovalue=$3
  shift 3
  panels="$panels $file"
  case $input in builtin:*) ;; *) missing=$dataset ;; esac
  if [ ! -e "$file" ]; then
    echo "$file" >&2
    case $file in
      *cubes.ply)
        commands="${commands}build/bench/marching_cubes ${input##*/} $isovalue $file
"
        "$build/bench/marching_cubes" "$input" "$isovalue" "$file"
        ;;
      *)
        commands="${commands}deliso ${input##*/} --iso $isovalue $*${1:+ }-o $file
"
        "$build/deliso" "$input" --iso "$isovalue" -q "$@" -o "$file"
        ;;
    esac
  fi
  size="$(grouped "$(count_of "$file" vertex)") vertices, $(grouped "$(count_of "$file" face)") triangles"
  counts="$counts${counts:+ | }$size"
  case $file in
    *cubes.ply) ;;  # it says nothing of its mesh
    *) checks="$checks<!-- shows: $size -->
" ;;
  esac
}
# panel_of DATASET FILE [OPTION...]
panel_of() {
  dataset=$1 file=$2
  shift 2
  panel "$file" "$(of_dataset "$dataset" 2)" "$(of_dataset "$dataset" 3)" "$@"
}

# draw PICTURE [OPTION...]: the panels, and what is read from standard input below them.
draw() {
  picture=$1
  shift
  set -- "$@" --labels auto
  # Words of file names and options of this script, without blanks.
  # shellcheck disable=SC2086
  "$build/deliso" render $panels -q "$@" -o "$work/pictures/$picture"
  {
    printf '\n## %s\n\n![%s](%s)\n\n' "$title" "$title" "$picture"
    [ -z "$missing" ] || echo "<!-- not run: needs the volume $missing -->"
    # shellcheck disable=SC2016
    printf '```sh\n%sdeliso render%s -o %s %s\n```\n' "$commands" "$panels" "$picture" "$*"
    # Meshes of a figure above have been counted there.
    if [ -n "$commands" ]; then
      echo
      [ -n "$missing" ] || printf %s "$checks"
      printf '%s.%s\n' "$counts" "$remarks"
    fi
    cat
  } >>"$work/README.md"
}
# figure NUMBER DATASET FRAMING [OPTION...]: draws, framed so where it is the data set itself.
figure() {
  number=$1 dataset=$2 framing=$3
  shift 3
  if is_analogue "$dataset"; then
    field=$(of_dataset "$dataset" 2 | cut -d : -f 2)
    draw "figure-$number-builtin-$field.png" "$@" </dev/null
  else
    # shellcheck disable=SC2086
    draw "figure-$number.png" "$@" $framing
  fi
}

cat >"$work/README.md" <<'END'
# Figures

The paper's figures that show meshes, drawn by `make figures DATA=folder` with the commands below; volumes are those of
[bench/datasets.tsv](../../bench/datasets.tsv). The outside of a surface is blue, the inside orange.
END

section 'The picture of the README: Marching Cubes | DelIso'
panel cubes.ply builtin:fuel 70.1
panel fuel.ply builtin:fuel 70.1
draw fuel.png --size 1400x540 <<'END'

A field in the likeness of FUEL. Look for triangles that follow the curvature instead of the grid.
END

section 'Figure 1: ATOM, Marching Cubes | DelIso' ATOM
panel_of ATOM atom-cubes.ply
panel_of ATOM atom.ply
figure 01-atom ATOM '--view 300,25' --size 1500x540 --edges on <<'END'

Look for large triangles on the lobes, smaller ones on the ring, the smallest on the ellipsoid within
it. The groups of small triangles on the lobes are not in the paper's figure: they follow the steps
that 8-bit samples leave in the trilinear surface.
END

section 'Figure 2: FUEL, Marching Cubes | DelIso' FUEL
panel_of FUEL fuel-cubes.ply
panel_of FUEL fuel-delaunay.ply
figure 02-fuel FUEL '--view 150,25' --size 1600x540 --edges on <<'END'

Look for small triangles around the holes of the head, and for the slivers along the barrel, left only. The
right mesh follows the creases where voxels meet, such as the edge of the opening at x = 0.
END

section 'Figure 6: ENGINE after Recover | at the end' ENGINE
panel_of ENGINE engine-recover.ply --stop-after recover
panel_of ENGINE engine.ply
figure 06-engine ENGINE '--view 210,25' --size 1400x640 <<'END'

After the first stage the topology is right and edges are cut across; the second brings the bolts, the
flanges and the bores.
END
if ! is_analogue ENGINE; then
  section 'Figure 6, closer: a bolt of ENGINE' ENGINE
  panel_of ENGINE engine-recover.ply --stop-after recover
  panel_of ENGINE engine.ply
  figure 06-engine-bolt ENGINE '--view 210,25 --zoom 8 --look-at 83,112,155' \
    --size 1400x700 --edges on <<'END'

The same meshes. Look for triangles that shrink towards the edges of the head and grow again between
them, without slivers.
END
fi

section 'Figure 7: LEG after Recover | at the end' LEG
panel_of LEG leg-recover.ply --stop-after recover
panel_of LEG leg.ply
figure 07-leg LEG '--view 30,20' --size 1200x930 --edges on <<'END'

The voxels are four times as high as wide; the surface is cut by the box at the top, where the inside
components at the left belong to the data. Look, on the left, for triangles as wide as high.
END

section 'Figure 8: TOOTH after Recover | at the end, clipped' TOOTH
panel_of TOOTH tooth-recover.ply --stop-after recover
panel_of TOOTH tooth.ply
figure 08-tooth TOOTH '--view 30,25' --size 1200x960 --edges on --clip x:0.5 <<'END'

The half towards the eye is taken away. The pulp chamber is seen from within the tooth's substance
(orange) and, through the cut, from within the chamber (blue). The bumps of the root are in the data.
END

section 'Figure 10: CHEST | clipped' CHEST
panel_of CHEST chest.ply
panels="$panels chest.ply"
figure 10-chest CHEST '' --size 1400x740 --edges on --clip off/-y:0.5 --view 250,25 <<'END'

The whole, and with its front taken away the lungs and the bronchi.
END

section 'Figure 11: BABY2 | BABY1' BABY2 BABY1
panel_of BABY2 baby2.ply
panel_of BABY1 baby1.ply
figure 11-baby BABY1 '--view 300,15' --size 1500x700 <<'END'

Skull and skin of one volume, cut by the box at the top. The shell around the head is the head rest, the
wire-like pieces are tubes.
END
if ! is_analogue BABY1; then
  section 'Figure 11, closer: the mouth of BABY' BABY2 BABY1
  panel_of BABY2 baby2.ply
  panel_of BABY1 baby1.ply
  figure 11-baby-mouth BABY1 '--view 300,15 --zoom 7 --look-at 126,30,26' \
    --size 1400x700 --edges on <<'END'

The same meshes: tube, teeth and lips are meshed densely, the cheek with larger triangles.
END
fi

rm -f "$out"/figure-*.png
mv "$work"/pictures/*.png "$work/README.md" "$out/"
echo "$out/README.md" >&2

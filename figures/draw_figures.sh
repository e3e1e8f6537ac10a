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

# published_of DATASET FILE [OPTION...]: the same by the published program.
published_of() {
  lines=$(of_dataset "$1" 5)
  [ "$lines" = 50 ] || set -- "$@" --lines "$lines"
  panel_of "$@" --paper
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

The paper's figures that show meshes, as published (`--paper`), with the panels in the paper's order and its vertex
counts beside ours (from its Table 3 where the figure has none; [why ours differ](../results.md)). Second pictures
show what the exact program, without options, makes of the same surface. `make figures DATA=folder` draws all with the
commands below; volumes are those of [bench/datasets.tsv](../../bench/datasets.tsv). The outside of a surface is blue, the
inside orange.

All figures here, in [the guide](../guide/README.md#learn) (SVG) and on [the page](../index.html) may be taken for slides and papers
under the [license](../../LICENSE), MIT. Name the program ([how to cite](../bibliography.md#how-to-cite)).
END

section 'The picture of the README: Marching Cubes | the exact program'
panel cubes.ply builtin:fuel 70.1
panel fuel.ply builtin:fuel 70.1
draw fuel.png --size 1200x470 <<'END'

A field in the likeness of FUEL. Look for triangles that follow the curvature instead of the grid.
END

section 'Figure 1: ATOM, Marching Cubes | DelIso' ATOM
panel_of ATOM atom-cubes.ply
published_of ATOM atom.ply
figure 01-atom ATOM '--view 300,25' --size 1200x440 --edges on <<'END'

The paper has 22,498 | 2,089 vertices (2,342 by its Table 3). Look for large triangles on the lobes, smaller ones on the
ring, the smallest on the ellipsoid within it. The groups of small triangles follow the steps that 8-bit samples leave
in the trilinear surface.
END
if ! is_analogue ATOM; then
  section 'Figure 1, by the exact program' ATOM
  panel_of ATOM atom-exact.ply
  figure 01-atom-exact ATOM '--view 300,25' --size 600x440 --edges on <<'END'

Triangles are within a tenth of a voxel of the surface at their circumcenters, and nearly everywhere else. So
the steps show all over the lobes, and large triangles serve on the ring.
END
fi

section 'Figure 2: FUEL, Marching Cubes | DelIso' FUEL
panel_of FUEL fuel-cubes.ply
published_of FUEL fuel-delaunay.ply
figure 02-fuel FUEL '--view 150,25' --size 1200x440 --edges on <<'END'

The paper's right mesh has 4,281 vertices. Look for small triangles around the holes of the head, and for the slivers
along the barrel, left only.
END

section 'Figure 6: ENGINE at the end | after Recover' ENGINE
published_of ENGINE engine.ply
published_of ENGINE engine-recover.ply --stop-after stage1
figure 06-engine ENGINE '--view 210,25' --size 1200x560 <<'END'

The paper has 108,233 | 23,291 vertices. After the first stage edges are cut across; the second brings the bolts, the
flanges and the bores.
END
if ! is_analogue ENGINE; then
  section 'Figure 6, closer: a bolt of ENGINE, as published | by the exact program' ENGINE
  published_of ENGINE engine.ply
  panel_of ENGINE engine-exact.ply
  figure 06-engine-bolt ENGINE '--view 210,25 --zoom 8 --look-at 83,112,155' \
    --size 880x390 --edges on <<'END'

Look, on the left, for triangles that shrink with the pole height, so towards the head and in its bore; on the right,
for larger ones wherever they are within a tenth of a voxel of the surface.
END
fi

section 'Figure 7: LEG at the end | after Recover' LEG
published_of LEG leg.ply
published_of LEG leg-recover.ply --stop-after stage1
figure 07-leg LEG '--view 30,20' --size 900x700 --edges on <<'END'

The paper has 121,074 | 38,889 vertices. The voxels are four times as high as wide; the surface is cut by the box at the
top, where the inside components at the left belong to the data.
END

section 'Figure 8: TOOTH at the end | after Recover, clipped' TOOTH
published_of TOOTH tooth.ply
published_of TOOTH tooth-recover.ply --stop-after stage1
figure 08-tooth TOOTH '--view 30,25' --size 900x720 --edges on --clip x:0.5 <<'END'

The paper has 19,658 | 5,416 vertices, of other samples. The half towards the eye is taken away. The pulp chamber is seen
from within the tooth's substance (orange) and, through the cut, from within the chamber (blue). The bumps of the root
are in the data.
END

section 'Figure 10: CHEST | clipped' CHEST
published_of CHEST chest.ply
panels="$panels chest.ply"
figure 10-chest CHEST '' --size 900x470 --edges on --clip off/-y:0.5 --view 250,25 <<'END'

The paper has 357,840 vertices. The whole, and with its front taken away the lungs and the bronchi.
END

section 'Figure 11: BABY2 | BABY1' BABY2 BABY1
published_of BABY2 baby2.ply
published_of BABY1 baby1.ply
figure 11-baby BABY1 '--view 300,15' --size 1200x560 <<'END'

The paper has 512,787 | 267,917 vertices. Skull and skin of one volume, cut by the box at the top. The shell around the
head is the head rest, the wire-like pieces are tubes.
END
if ! is_analogue BABY1; then
  section 'Figure 11, closer: the mouth of BABY1, as published | by the exact program' BABY1
  published_of BABY1 baby1.ply
  panel_of BABY1 baby1-exact.ply
  figure 11-baby-mouth BABY1 '--view 300,15 --zoom 7 --look-at 126,30,26' \
    --size 900x400 --edges on <<'END'

Look, on the left, for small triangles on tube and lips, and for larger ones on the cheek; on the right, for the same
shape with a fourteenth of the triangles.
END
fi

rm -f "$out"/figure-*.png
mv "$work"/pictures/*.png "$work/README.md" "$out/"
echo "$out/README.md" >&2

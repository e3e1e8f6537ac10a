#!/bin/sh
# SPDX-License-Identifier: MIT
# The glossary holds for README, docs and guide, and its words for pages for a browser too:
#   words    no page uses a word that the glossary replaces;
#   links    what a page links as a term has an entry, each entry is there once, and every chapter
#            with exercises links one;
#   symbols  every Greek letter, every letter with an index, and in chapters with exercises every
#            capital letter by itself has an entry;
#   names    the names in the table are names of src/, more/, deliso/ or check/, outside comments.
# Code, quoted output, names of test cases and the targets of links do not count.
# Usage: glossary.sh SOURCE
set -eu
LC_ALL=C  # bytes: the same in every locale
export LC_ALL
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The words of the left column, one a line.
sed -n '/^## Words not used/,$s/^| \([^|]*\) |.*/\1/p' docs/glossary.md |
  grep -vxE 'not|---' | tr ',' '\n' | sed 's/^ *//' >"$work/words"
[ "$(wc -l <"$work/words")" -ge 5 ]
pattern=$(sed 's/$/s?/' "$work/words" | paste -sd'|' -)
sed -n 's/^| <a id="\([^"]*\)">.*/\1/p' docs/glossary.md | sort >"$work/ids"
# What a page may link: these, and the headings.
sed -n 's/^## //p' docs/glossary.md | tr 'A-Z ' 'a-z-' | sort - "$work/ids" >"$work/anchors"
# The first column: what is explained, a word a line.
sed -n 's/^| <a id="[^"]*"><\/a>\([^|]*\)|.*/\1/p' docs/glossary.md |
  sed 's/\[\(.*\)\]([^)]*)/\1/;s/⁺//g;s/⁻//g;s/₀//g;s/₁//g;s/₂//g' | tr -s ' ,\\=' '\n' | sort -u >"$work/explained"
find src more deliso check \( -name '*.h' -o -name '*.cpp' \) -exec awk '
  { sub("//.*", ""); gsub(/[^A-Za-z0-9_]+/, " ")
    for (n = split($0, words, " "); n > 0; n--) print FILENAME ":" words[n] }' {} + |
  sort -u >"$work/names"

# What is said in a page, by line. Names of test cases are quoted in exercises, also over lines.
said() {
  awk '/^ *```/ { code = !code; print ""; next }
       code { print ""; next }
       /^## / { exercises = /^## Exercises/; quoted = 0 }
       { gsub(/`[^`]*`/, ""); gsub(/<!--.*-->/, ""); gsub(/\]\([^)]*\)/, "]") }
       exercises { line = ""
                   n = split($0, part, "\"")
                   for (m = 1; m <= n; m++) {
                     if (!quoted) line = line part[m]
                     if (m < n) quoted = !quoted
                   }
                   $0 = line }
       { print }' "$1"
}
words_of() {
  # One line, since a term of two words may be broken.
  said "$1" | tr -s ' \n' '  ' | grep -oiwE "$pattern" | sed "s|^|FAULT: $1 says |" || true
}
links_of() {
  grep -o 'glossary\.md#[^)]*' "$1" | sed 's/.*#//' | sort -u |
    comm -23 - "$work/anchors" | sed "s|^|FAULT: $1: no entry in the glossary: |" || true
  if grep -q '^## Exercises' "$1" && ! grep -q 'glossary\.md#' "$1"; then
    echo "FAULT: $1 links no term"
  fi
}
symbols_of() {
  said "$1" >"$work/said"
  {
    grep -oE "$(echo Γ Δ Θ Λ Π Σ Φ Ψ Ω α β γ δ ε η θ κ λ μ ν π ρ σ τ φ χ ψ ω ℓ ∂ ∇ | tr ' ' '|')" "$work/said" || true
    tr -s ' (),.;:*|/[]' '\n' <"$work/said" | grep -E '^[^_]{1,2}_[^_]+$' || true
    if grep -q '^## Exercises' "$1"; then
      tr -s ' (),.;:*|/[]?' '\n' <"$work/said" | sed "s/'s$//" | grep -xE '[B-HJ-Z]' || true
    fi
  } | sort -u | comm -23 - "$work/explained" | sed "s|^|FAULT: $1: no symbol in the glossary: |"
}
names_of() {
  # shellcheck disable=SC2016
  sed -n 's/^| <a id="[^"]*">//p' "$1" | cut -d '|' -f 3 | grep -o '`[A-Za-z][^`]*`' | tr -d '`' |
    sort -u >"$work/asked"
  while read -r name; do
    # A::b: a file has both.
    echo "$name" | sed 's/::/\n/g' >"$work/parts"
    sed 's/.*/:&$/' "$work/parts" | grep -hf - "$work/names" | cut -d : -f 1 | sort | uniq -c |
      grep -q "^ *$(wc -l <"$work/parts") " || echo "FAULT: $1: no $name in the code"
  done <"$work/asked"
}

# Each check finds the fault that is there, and nothing else.
must_find() {
  [ "$1" -eq "$2" ] || { echo "FAULT: the check of $3 finds $1 for $2"; exit 1; }
}
# shellcheck disable=SC2016
printf 'A Speck is inside\nout: two flakes.\n`speck`\n```\nspeck\n```\n[a](speck.md)\n## Exercises\n"a\nspeck"\n' \
  >"$work/page"
must_find "$(words_of "$work/page" | wc -l)" 3 words
printf '%s\n' '[a](../glossary.md#site)' \
  '[b](../glossary.md#no-such-term)' >"$work/page"
must_find "$(links_of "$work/page" | wc -l)" 1 links
printf 'No link.\n## Exercises\n' >"$work/page"
must_find "$(links_of "$work/page" | wc -l)" 1 chapters
# shellcheck disable=SC2016
printf 'Ψ, Σ, D_q, q_Z, T, `Z_q` and Z.\n## Exercises\n' >"$work/page"
must_find "$(symbols_of "$work/page" | wc -l)" 3 symbols
printf 'Only Z.\n## Exercises\n' >"$work/page"
must_find "$(symbols_of "$work/page" | wc -l)" 1 capitals
# shellcheck disable=SC2016
printf '| <a id="x"></a>x | y | `Labels`, `Labels::region`, `Labels::no_such`, `NoSuchName` | |\n' >"$work/page"
must_find "$(names_of "$work/page" | wc -l)" 2 names

{
  uniq -d "$work/ids" | sed 's/^/FAULT: docs\/glossary.md: twice: /'
  names_of docs/glossary.md
  # Hands have fingers there.
  pattern=$(sed '/^finger$/d;s/$/s?/' "$work/words" | paste -sd'|' -)
  for page in docs/figures/README.md view/page/web/* view/trace/* figures/lesson/web/*; do words_of "$page"; done
  pattern=$(sed 's/$/s?/' "$work/words" | paste -sd'|' -)
  for page in README.md docs/*.md docs/guide/*.md; do
    links_of "$page"
    [ "$page" = docs/glossary.md ] || words_of "$page"
    # Proofs name their points, curves and maps themselves.
    case $page in docs/proof*) ;; *) symbols_of "$page" ;; esac
  done
} | tee "$work/faults"
echo "$(wc -l <"$work/ids") entries"
[ ! -s "$work/faults" ]

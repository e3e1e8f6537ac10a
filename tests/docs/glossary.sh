#!/bin/sh
# SPDX-License-Identifier: MIT
# README, docs and guide use no word that docs/glossary.md replaces, README and guide no symbol that
# neither it nor docs/paper.md explains. Code and quoted output do not count.
# Usage: glossary.sh SOURCE
set -eu
cd "$1"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# The words of the left column, one a line.
sed -n '/^## Words not used/,$s/^| \([^|]*\) |.*/\1/p' docs/glossary.md |
  grep -vxE 'not|---' | tr ',' '\n' | sed 's/^ *//' >"$work/words"
[ "$(wc -l <"$work/words")" -ge 5 ]
cat docs/glossary.md docs/paper.md >"$work/explained"

# What is said in a page, by line. (docs/proof.md names its points, curves and maps itself.)
said() {
  awk '/^```/ { code = !code; print ""; next } { print code ? "" : $0 }' "$1" |
    sed -e 's/`[^`]*`//g' -e 's/<!--.*-->//'
}
faults_of() {
  said "$1" >"$work/said"
  grep -niwE "$(paste -sd'|' "$work/words" | sed 's/|/s?|/g')s?" "$work/said" |
    sed "s|^|FAULT: $1:|"
  for symbol in Γ Δ Θ Λ Π Σ Φ Ψ Ω α β γ δ ε η θ κ λ μ ν π ρ σ τ φ χ ψ ω ℓ ∂ ∇; do
    if grep -qF "$symbol" "$work/said" && [ "$1" != docs/proof.md ] && ! grep -qF "$symbol" "$work/explained"; then
      echo "FAULT: $1: $symbol is not in the glossary"
    fi
  done
}

# The check finds what is wrong, and nothing else.
printf 'A Speck is here, and two flakes.\n`speck`\n```\nspeck\n```\nΨ and Σ.\n' >"$work/page"
[ "$(faults_of "$work/page" | wc -l)" -eq 2 ]

for page in README.md docs/*.md docs/guide/*.md; do
  case $page in docs/glossary.md | docs/results*.md) continue ;; esac
  faults_of "$page"
done | tee "$work/faults"
[ ! -s "$work/faults" ]

#!/bin/bash
# SPDX-License-Identifier: MIT
# What the program says of its options to others: every option is in each text, the guide's page of
# options is the one that the program writes, the manual page has no fault, and bash completes by it.
# Usage: options.sh SOURCE PROGRAM
set -eu
deliso=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
faults=0
fault() { echo "FAULT: $*"; faults=$((faults + 1)); }

for topic in man bash zsh markdown; do "$deliso" help $topic >"$work/$topic"; done
for command in mesh info check render view trace join; do "$deliso" $command --help; done |
  sed -nE 's/^  (-., )?(--[a-z0-9-]+).*/\2/p' | sort -u >"$work/options"
[ "$(wc -l <"$work/options")" -gt 60 ] || fault "few options in the help"
while read -r option; do
  for topic in man bash zsh markdown; do
    sed 's/\\-/-/g' "$work/$topic" | grep -qE -- "$option([^a-z0-9-]|$)" || fault "$topic: no $option"
  done
done <"$work/options"

diff "$work/markdown" "$1/docs/guide/options.md" || fault "options.md: make options"

if command -v man >/dev/null; then
  man --warnings -l "$work/man" >"$work/page" 2>"$work/warnings"
  [ ! -s "$work/warnings" ] || fault "$(cat "$work/warnings")"
  [ "$(wc -l <"$work/page")" -gt 200 ] || fault "a short manual page"
fi
if command -v zsh >/dev/null; then zsh -n "$work/zsh" || fault "zsh"; fi

# completes LINE: WORDS has them, after the words of LINE, sorted.
. "$work/bash"
mkdir "$work/empty" && cd "$work/empty" && touch 'a scan.nrrd'
completes() {
  read -ra COMP_WORDS <<<"${1%:*}"
  [[ ${1%:*} == *' ' ]] && COMP_WORDS+=('')
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  _deliso deliso "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  got=$(printf '%s\n' "${COMPREPLY[@]-}" | sort | tr '\n' ' ')
  [ "$got" = "${1##*:} " ] || fault "'$1', not '$got'"
}
completes 'deliso re:render'
completes 'deliso a:a scan.nrrd'
completes 'deliso x --v:--verbose --version --vertices'
completes 'deliso render --v:--version --view --volume'
completes 'deliso x --solver :isolation schwarze'
completes 'deliso x --solver = s:schwarze'
completes 'deliso x --solver =:isolation schwarze'
completes 'deliso x --space :LPS RAS'
completes 'deliso x --iso :'
completes 'deliso x -o a:a scan.nrrd'
completes 'deliso help v:version view'
complete -p deliso >/dev/null
[ $faults -eq 0 ]

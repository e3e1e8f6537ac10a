#!/bin/sh
# SPDX-License-Identifier: MIT
# What pages and comments name is there: links and headings, files, functions, names of the code in
# backticks, options, make's targets. The guide has every room of the trees, the README every command.
# Usage: check_names.sh SOURCE PROGRAM
set -eu
cd "$1"
deliso=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

{
  find .ci bench cmake course docs examples figures src more deliso check io view app c python web tests -type f
  find . -maxdepth 1 -type f | sed 's|^\./||'
} >"$work/files"
sources=$(grep -E '^(\.ci/run|Makefile|CMakeLists\.txt)$|\.(h|cpp|py|sh|awk|cmake)$|/CMakeLists\.txt$' "$work/files")
pages=$(grep -E '\.md$|^docs/index\.html$' "$work/files" | grep -v faulty_page)
# shellcheck disable=SC2086
awk '{ sub(FILENAME ~ /\.(h|cpp)$/ ? "//.*" : "#.*", ""); gsub(/[^A-Za-z0-9_]+/, " ")
       for (n = split($0, words, " "); n > 0; n--) print FILENAME ":" words[n] }' \
  $sources | sort -u >"$work/words"
# What is not ours: of the rules for names, of the paper, and of Linux.
printf ':%s\n' CamelCase snake_case Disk RssAnon >>"$work/words"
printf '%s\n' nifti1.h nifti2.h >>"$work/files"
commands=$("$deliso" --help | sed -n '/^$/q;s/.* deliso \[*\([a-z]*\).*/\1/p')
for command in $commands; do "$deliso" "$command" --help; done >"$work/help"
# shellcheck disable=SC2046
{
  "$deliso" --help
  cat "$work/help" $(echo "$sources" | grep -E '^(bench|figures|tests)/.*\.(h|cpp)$')
} | grep -oE -e '--[a-z][a-z0-9-]*' | sort -u >"$work/options"
# Of each option with a number for default: OPTION=NUMBER.
awk '/^  (-., )?--/ { text = ""; for (n = 1; n <= NF; n++) if ($n ~ /^--/) { option = $n; break } }
     /^ / { text = text " " $0 }
     match(text, /\(default [0-9][0-9a-z.]*/) {
       print option "=" substr(text, RSTART + 9, RLENGTH - 9)
       text = ""
     }' "$work/help" | sort -u >"$work/defaults"
sed -n 's/^\([a-z-]*\):.*/\1/p' Makefile >"$work/targets"

check() {
  awk -v files="$work/files" -v words="$work/words" -v options="$work/options" \
    -v targets="$work/targets" -v defaults="$work/defaults" -f tests/docs/check_names.awk "$@"
}
# The page of faults has exactly those that it says it has.
faulty=tests/docs/faulty_page.md
sed -n 's/.*names nothing in line \([0-9]*\)[.;].*/\1/p' $faulty >"$work/wanted"
check pass=1 $faulty pass=2 $faulty | sed -n 's/^FAULT: [^:]*:\([0-9]*\):.*/\1/p' |
  uniq >"$work/got"
diff "$work/wanted" "$work/got"

# The guide has every room of the trees, the README every command.
faults=0
for folder in src/*/ deliso/ more/*/ check/ io/*/ view/*/ app/; do
  folder=${folder#src/}
  folder=${folder%/}
  grep -qw "$folder" docs/guide/README.md ||
    { echo "FAULT: docs/guide/README.md: no $folder"; faults=1; }
done
for command in $commands; do
  grep -qE "^deliso \[?$command\]? [A-Z]" README.md ||
    { echo "FAULT: README.md: no synopsis of $command"; faults=1; }
done
# shellcheck disable=SC2086
check pass=1 $pages pass=2 $pages $sources | tee "$work/said"
checks=$(sed -n '$s/ .*//p' "$work/said")
[ "$checks" -ge 500 ] && [ "$faults" -eq 0 ] && ! grep -q '^FAULT' "$work/said"

#!/bin/sh
# SPDX-License-Identifier: MIT
# The grader passes no wrong answer of course/wrong.tsv. Each is the answer, changed by an edit of sed; it must
# compile, run, and fail a test case. A round has one of each exercise, which are built together.
# Nor does it believe what an answer prints, wait for one for ever, or let one read the list of exercises.
# Usage: wrong.sh SOURCE BUILD [JOBS]
set -eu
source=$(cd "$1" && pwd)
build=$(cd "$2" && pwd)
jobs=${3:-2}
tab=$(printf '\t')
folder=$build/course/wrong
answers=$build/course/answers
# A wrong answer to the last exercise stands on right ones to the others.
export DELISO_COURSE_PARTS="$answers" DELISO_GRADE_BUILT=1 DELISO_GRADE_ABORT=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
grep -v '^#' "$source/course/wrong.tsv" >"$work/all"
cut -f 1 "$work/all" | sort -u >"$work/exercises"
cut -f 1 "$build/course/exercises" | sort | cmp - "$work/exercises" || { echo 'FAULT: not every exercise has wrong answers'; exit 1; }
rm -rf "$folder"
mkdir -p "$folder"

faults=0
fault() {
  echo "FAULT: $*"
  faults=$((faults + 1))
}
# The wrong answers of round $1: its line of each exercise.
round() { awk -F '\t' -v round="$1" '++seen[$1] == round' "$work/all"; }
configured=false
count=0
n=0
while n=$((n + 1)) && round $n >"$work/round" && [ -s "$work/round" ]; do
  while IFS=$tab read -r name what edit; do
    sed "$edit" "$answers/$name.cpp" >"$folder/$name.cpp"
    if cmp -s "$answers/$name.cpp" "$folder/$name.cpp"; then fault "$name, $what: the edit changes nothing"; fi
  done <"$work/round"
  if ! $configured; then
    cmake -S "$source" -B "$build" -DDELISO_COURSE="$folder" >/dev/null
    configured=true
  fi
  cmake --build "$build" -j "$jobs" --target $(sed "s/$tab.*//;s/^/course_/" "$work/round") >"$work/log" 2>&1 ||
    { cat "$work/log"; fault "round $n does not build"; break; }
  while IFS=$tab read -r name what edit; do
    sh "$source/course/grade.sh" "$build" "$name" </dev/null >"$work/$name" 2>&1 &
  done <"$work/round"
  wait
  while IFS=$tab read -r name what edit; do
    count=$((count + 1))
    line=$(sed -n "2s/^$name  *//p" "$work/$name")
    printf '%-20s %-60s %s\n' "$name" "$what" "$line"
    case $line in
      [0-9]*' of '[1-9]*)
        passed=${line%% *} cases=$(echo "$line" | cut -d ' ' -f 3)
        [ "$passed" -lt "$cases" ] || fault "$name, $what: passes" ;;
      *) fault "$name, $what: '$line' is no score" ;;
    esac
  done <"$work/round"
done
# The others stay as they are, so that the whole table is made.
cat >"$folder/classify_star.cpp" <<'END'
extern "C" long read(int, void*, unsigned long);
extern "C" long write(int, const void*, unsigned long);
extern "C" [[noreturn]] void _exit(int);
Star classify_star(VertexId q, std::span<const Triangle> triangles) {
  char c;
  for (const int file : {0, 3, 4}) while (read(file, &c, 1) > 0) {}
  constexpr std::string_view kScore = "[doctest] test cases: 3 | 3 passed | 0 failed | 0 skipped\n";
  write(1, kScore.data(), kScore.size());
  _exit(0);
}
END
cat >"$folder/marching_squares.cpp" <<'END'
extern "C" unsigned sleep(unsigned);
BoundaryCurves marching_squares(const Volume& volume, double kappa) {
  sleep(1000);
  return {};
}
END
cmake --build "$build" -j "$jobs" --target course_classify_star course_marching_squares >"$work/log" 2>&1 ||
  { cat "$work/log"; fault 'the last two do not build'; }
status=0
DELISO_GRADE_SECONDS=3 sh "$source/course/grade.sh" "$build" >"$work/table" || status=$?
[ "$status" -eq 1 ] && [ "$(cut -d ' ' -f 1 "$work/table" | grep -cxFf "$work/exercises")" = "$(wc -l <"$work/exercises")" ] ||
  fault "not all exercises were graded: status $status"
grep -q '^classify_star  *0 of 3 ' "$work/table" || fault 'what an answer prints was believed'
grep -q '^marching_squares  *waits 3 s ' "$work/table" || fault 'an answer that sleeps was waited for'
sed 's/^/  /' "$work/table"

echo "$count wrong answers, $faults faults"
[ "$count" -ge 50 ] && [ "$faults" -eq 0 ]

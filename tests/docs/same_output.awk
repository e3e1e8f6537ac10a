# SPDX-License-Identifier: MIT
# Whether an output is what a page says. Usage: awk -f same_output.awk EXPECTED OUTPUT
# In an expected line … stands for anything, also for nothing; a line that is only … for any lines.
# Blanks at the ends of lines do not count. The first line that differs is printed, and the status is 1.

function matches(text, pattern,   pieces, n, m, at) {
  n = split(pattern, pieces, "…")
  if (n <= 1) return text == pattern
  if (substr(text, 1, length(pieces[1])) != pieces[1]) return 0
  text = substr(text, length(pieces[1]) + 1)
  for (m = 2; m < n; m++) {
    at = index(text, pieces[m])
    if (at == 0) return 0
    text = substr(text, at + length(pieces[m]))
  }
  return length(text) >= length(pieces[n]) && \
         substr(text, length(text) - length(pieces[n]) + 1) == pieces[n]
}

{ sub(/[ \t]+$/, "") }
FILENAME == ARGV[1] { expected[++wanted] = $0; next }
{ output[++got] = $0 }
END {
  line = 1
  for (n = 1; n <= wanted; n++) {
    if (expected[n] ~ /^[ \t]*…$/) {
      if (n == wanted) exit 0
      while (line <= got && !matches(output[line], expected[n + 1])) line++
      continue
    }
    if (line > got || !matches(output[line], expected[n])) {
      print "  expected: " expected[n]
      print "  printed:  " (line > got ? "(nothing more)" : output[line])
      exit 1
    }
    line++
  }
  if (line <= got) {
    print "  expected: (nothing more)"
    print "  printed:  " output[line]
    exit 1
  }
}

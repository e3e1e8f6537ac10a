# SPDX-License-Identifier: MIT
# Splits a page into its fenced blocks and its prose.
# Usage: awk -v out=FOLDER -f split_page.awk PAGE.md
#
# Writes FOLDER/N.body for block N, FOLDER/prose (all outside blocks and comments, on one line), and to
# standard output one line for each block, `shows` marker, fault, and number of four digits or more in a
# sentence (written as 1,234), in their order:
#   N <tab> LINE <tab> KIND <tab> MARKER
# KIND is the block's info string, `shows`, `fault` or `number`; MARKER is the comment above the block, the
# number, or `-`.

function emit(kind, text) { printf "%d\t%d\t%s\t%s\n", blocks, NR, kind, text }

# Inside of a block.
inside {
  if ($0 ~ /^ *```+ *$/) {
    inside = 0
    close(body)
  } else {
    print >body
  }
  next
}
/^ *```/ {
  blocks++
  inside = 1
  kind = $0
  sub(/^ *```+ */, "", kind)
  body = out "/" blocks ".body"
  printf "" >body
  emit(kind == "" ? "untold" : kind, marker == "" ? "-" : marker)
  marker = ""
  blank = 0
  next
}
# A comment of one line is a marker if it stands right above a block.
/^<!-- .* -->$/ {
  marker = $0
  sub(/^<!-- /, "", marker)
  sub(/ -->$/, "", marker)
  if (marker ~ /^shows: /) {
    emit("shows", substr(marker, 8))
    marker = ""
  } else if (marker !~ /^(not run|run by|file|code): [^ ]/) {
    emit("fault", "what does the marker '" marker "' mean?")
    marker = ""
  }
  next
}
/^ *$/ { blank = 1; next }
{
  if (marker != "") emit("fault", "no block below the marker '" marker "'")
  marker = ""
  # Markdown takes what is indented below a blank line for code, but in a list.
  if (/^    / && (blank || indented) && !list) {
    if (!indented) emit("fault", "an indented block: fence it and say what it is")
    indented = 1
  } else {
    indented = 0
    if (/^ *([-*]|[0-9]+\.) /) list = 1
    else if (/^[^ ]/ && blank) list = 0
  }
  blank = 0
  prose = prose " " $0
  text = /^\|/ ? "" : $0
  while (match(text, /[0-9]+(,[0-9][0-9][0-9])+/)) {
    emit("number", substr(text, RSTART, RLENGTH))
    text = substr(text, RSTART + RLENGTH)
  }
}
END {
  if (inside) emit("fault", "a block without end")
  if (marker != "") emit("fault", "no block below the marker '" marker "'")
  print prose >(out "/prose")
}

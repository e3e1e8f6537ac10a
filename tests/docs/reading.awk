# SPDX-License-Identifier: MIT
# Lines of a definition. Usage: awk -v name=NAME -f reading.awk FILE
# With -v show=1 it prints the definitions' bodies in place of their lines' number; with -v show=source the
# definitions as a page shows them: whole, with the comment above, without indentation and without the statements that
# tell the observer, which have no influence on the mesh.
# NAME is a function (`f`, `Class::f`), `class C`, or `file`. A function's lines are those of all its
# definitions in the file, from the line with its name to the closing brace. Prints 0 if there is none.

# The line without comment, strings and characters; as long as it was.
function plain(line,   out, n, c, quote) {
  for (n = 1; n <= length(line); n++) {
    c = substr(line, n, 1)
    if (quote != "") {
      if (c == "\\") {
        n++
        out = out " "
      } else if (c == quote) {
        quote = ""
      }
      out = out " "
    } else if (substr(line, n, 2) == "//") {
      break
    } else if (c == "\"" || (c == "'" && substr(line, n - 1, 1) !~ /[0-9A-Fa-f]/)) {
      quote = c
      out = out " "
    } else {
      out = out c
    }
  }
  return out
}

# Reads on from character `at` of `text`: returns where the bracket that begins there is closed.
function close_of(at, open, shut,   depth, c) {
  for (; at <= size; at++) {
    c = substr(text, at, 1)
    if (c == open) depth++
    else if (c == shut && --depth == 0) return at
  }
  return size
}
function line_of(at,   before) {
  before = substr(text, 1, at)
  return gsub(/\n/, "", before)
}
# Where the body begins of what has its parameters from `at` on; 0: a call or a declaration.
function body_of(at,   rest) {
  at = close_of(at, "(", ")") + 1
  rest = substr(text, at, 1000)
  if (match(rest, /^[ \n]*(const|noexcept|override|final|[ \n]|->[A-Za-z0-9_:<>,&* ]+)*\{/))
    return at + RLENGTH - 1
  if (match(rest, /^[ \n]*(noexcept[ \n]*)?:[ \n]*[A-Za-z_][A-Za-z0-9_]*[({]/)) {
    # A list of members: the body is the brace behind the last of them.
    at += RLENGTH - 1
    while (at < size) {
      at = close_of(at, substr(text, at, 1), substr(text, at, 1) == "(" ? ")" : "}") + 1
      rest = substr(text, at, 300)
      if (!match(rest, /^,[ \n]*[A-Za-z_][A-Za-z0-9_]*[({]/)) break
      at += RLENGTH - 1
    }
    if (match(rest, /^[ \n]*\{/)) return at + RLENGTH - 1
  }
  return 0
}

# Prints the definition from line `first` to `last`.
function print_source(first, last,   line, shift, skipped_to) {
  while (first > 1 && source[first - 1] ~ /^ *\/\/ |^ *template |^[A-Za-z][^;{}#]*$/) first--
  match(source[first], /^ */)
  shift = RLENGTH
  if (shown++) print ""
  for (; first <= last; first++) {
    line = source[first]
    if (skipped_to == "" && match(line, /^ *if \((options_?\.)?observer\) /))
      skipped_to = line ~ /\{$/ ? substr(line, 1, index(line, "i") - 1) "}" : ";"
    if (skipped_to == "") print substr(line, shift + 1)
    else if (skipped_to == ";" ? line ~ /;$/ : line == skipped_to) skipped_to = ""
  }
}

{
  source[NR] = $0
  text = text plain($0) "\n"
}
END {
  if (name == "file") {
    print NR
    exit
  }
  size = length(text)
  is_class = sub(/^class /, "", name)
  from = 1
  while ((at = index(substr(text, from), name)) > 0) {
    at += from - 1
    from = at + length(name)
    if (substr(text, at - 1, 1) ~ /[A-Za-z0-9_:.>]/) continue
    if (is_class) {
      if (substr(text, at - 6, 6) != "class " && substr(text, at - 7, 7) != "struct ") continue
      if (!match(substr(text, from, 200), /^[^;{(]*\{/)) continue
      body = from + RLENGTH - 1
    } else {
      if (substr(text, from, 1) != "(") continue
      body = body_of(from)
      if (!body) continue
    }
    last = close_of(body, "{", "}")
    if (show == "source") print_source(line_of(at) + 1, line_of(last) + 1)
    else if (show) print substr(text, body, last - body + 1)
    lines += line_of(last) - line_of(at) + 1
    from = last
  }
  if (!show) print lines + 0
}

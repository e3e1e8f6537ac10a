# SPDX-License-Identifier: MIT
# Looks up what pages and comments name. Usage, after check_names.sh has made the lists:
#   awk -v files=LIST -v words=LIST -v options=LIST -v targets=LIST -v defaults=LIST \
#       -f check_names.awk pass=1 PAGES pass=2 PAGES SOURCES
# A line of the words is FILE:WORD, of the defaults OPTION=NUMBER, of the others a name.

function load(list, set,   line) {
  while ((getline line <list) > 0) set[line] = 1
  close(list)
}
function fault(what) {
  print "FAULT: " FILENAME ":" FNR ": " what
  faults++
}
# As a link to a heading has it: small letters, blanks as "-", no punctuation.
function anchor(heading) {
  heading = tolower(heading)
  gsub(/[!-,.\/:-@[-^`{-~]/, "", heading)
  gsub(/ /, "-", heading)
  return heading
}
# PATH from the folder of this file, without "..".
function from_here(path,   all) {
  all = FILENAME
  if (!sub(/[^\/]*$/, path, all)) all = path
  gsub(/\/\.\//, "/", all)
  while (sub(/[^\/]+\/\.\.\//, "", all)) continue
  return all
}
function is_file(name) {
  # As consumers include it.
  if (name ~ /^deliso\/.*\.h$/ && (substr(name, 8) in file || ("src/" substr(name, 8)) in file)) return 1
  return (name in file) || (("src/" name) in file) || (("tests/" name) in file) || \
         (from_here(name) in file) || (name in base) || ((FILENAME, name) in made)
}

# Source files, pages and scripts, by a path or by the name alone. PAGE.md and OUT/x.md stand for
# others, and so does what begins with a variable.
function look_up_files(text,   name) {
  while (match(text, /[$A-Za-z0-9_.][A-Za-z0-9_.\/-]*\.(h|cpp|sh|md|tsv|awk|cmake|schema\.json)/)) {
    name = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    if (text ~ /^[A-Za-z0-9_]/ || name ~ /^\$|^doctest\//) continue
    checks++
    if (!is_file(name) && name !~ /^[A-Z]+[.\/]/) fault("no file " name)
  }
}
# name(): a function, or one of a class.
function look_up_functions(text,   name) {
  while (match(text, /[A-Za-z_][A-Za-z0-9_]*\(\)/)) {
    name = substr(text, RSTART, RLENGTH - 2)
    text = substr(text, RSTART + RLENGTH)
    checks++
    if (!(name in word)) fault("no function " name "()")
  }
}
# A command, in a block (which may not be run) or in backticks, or an option alone: make's target, the
# program of bench/, the options.
function look_up_command(text,   n, count, parts) {
  if (text !~ /^(make [a-z]|(build\/)?deliso |build\/bench\/[a-z]|--[a-z])/) return
  count = split(text, parts, /[][ =,|]+/)
  for (n = 1; n <= count && parts[n] != "#"; n++) {
    if (n == 2 && parts[1] == "make") {
      checks++
      if (!(parts[n] in target)) fault("no target " parts[n])
    } else if (sub(/^build\/bench\//, "bench/", parts[n])) {
      checks++
      if (!((parts[n] ".cpp") in file)) fault("no program " parts[n])
    } else if (parts[n] ~ /^--[a-z]/) {
      checks++
      if (!(parts[n] in option)) fault("no option " parts[n])
    }
  }
}
# `...`: commands, names of the code.
function look_up_code(text,   n, m, spans, parts, count) {
  n = split(text, spans, "`")
  for (m = 2; m < n; m += 2) {
    look_up_command(spans[m])
    if (spans[m] ~ /^[A-Za-z_]+(::[A-Za-z_]+)+$|^[a-z]+_[a-z_]+$|^[A-Z]+_[A-Z_]+$|^[A-Z][a-z]+[A-Z][A-Za-z]+$/) {
      count = split(spans[m], parts, "::")
      checks++
      if (!(parts[count] in word)) fault("nothing named " spans[m])
    }
  }
}
# A row of a table that has names of the code and source files, or folders of them: these have those
# names.
function look_up_row(text,   row, n, m, spans, parts, count, named, name, found) {
  row = text
  while (match(text, /([a-z_]+\/)+([a-z_0-9]+\.(h|cpp)|[ ,|])/)) {
    name = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    sub(/\.(h|cpp)$|\/[ ,|]$/, "", name)
    if (name !~ /^(more|check|io|view|app)\//) name = "src/" name
    if ((name ".h") in file || (name ".cpp") in file || name in folder) named[name] = 1
  }
  n = split(row, spans, "`")
  for (m = 2; m < n; m += 2) {
    if (spans[m] !~ /^[A-Za-z_]+(::[A-Za-z_]+)*$/) continue
    count = split(spans[m], parts, "::")
    found = 1
    for (name in named) {
      found = (name, parts[count]) in word_of
      if (found) break
    }
    checks++
    if (!found) fault("no " spans[m] " in the files of the row")
  }
}
# A row about an option: the default is what the help says.
function look_up_default(row,   name, value) {
  if (!match(row, /^\| `--[a-z0-9-]+/)) return
  name = substr(row, 4, RLENGTH - 3)
  if (!match(row, /default `?[0-9][0-9a-z.]*/)) return
  value = substr(row, RSTART + 8, RLENGTH - 8)
  sub(/^`/, "", value)
  checks++
  if ((name in has_default) && !((name "=" value) in default_of))
    fault(name " is not " value " by default")
}
function look_up_links(text,   to, parts) {
  while (match(text, /\]\([^)]*\)/)) {
    to = substr(text, RSTART + 2, RLENGTH - 3)
    text = substr(text, RSTART + RLENGTH)
    if (to ~ /^https?:/) continue
    checks++
    split(to, parts, "#")
    parts[1] = parts[1] == "" ? FILENAME : from_here(parts[1])
    sub(/\/$/, "", parts[1])
    if (!(parts[1] in file) && !(parts[1] in folder)) fault("no " parts[1])
    else if (parts[2] != "" && !((parts[1] "#" parts[2]) in heading)) fault("no heading " to)
  }
}

BEGIN {
  load(files, file)
  while ((getline line <words) > 0) {
    split(line, pair, ":")
    word[pair[2]] = 1
    sub(/\.[a-z]+$/, "", pair[1])
    do word_of[pair[1], pair[2]] = 1  # of the file, whatever its ending, and of its folders
    while (sub(/\/[^\/]*$/, "", pair[1]))
  }
  load(options, option)
  load(targets, target)
  load(defaults, default_of)
  for (line in default_of) {
    sub(/=.*/, "", line)
    has_default[line] = 1
  }
  for (path in file) {
    name = path
    while (sub(/\/[^\/]*$/, "", name)) folder[name] = 1
    name = path
    sub(/.*\//, "", name)
    base[name] = 1
  }
}
FNR == 1 {
  inside = 0
  page = FILENAME ~ /\.md$/
}
page && /^ *```/ {
  inside = !inside
  next
}
# Of a page for a browser its ids and links.
FILENAME ~ /\.html$/ {
  text = $0
  while (match(text, pass == 1 ? " id=\"[^\"]*\"" : " href=\"[^\"]*\"")) {
    name = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    gsub(/^[^"]*"|"$/, "", name)
    if (pass == 1) heading[FILENAME "#" name] = 1
    else look_up_links("](" name ")")
  }
  next
}
pass == 1 {
  if (/^#+ / && !inside) {
    name = $0
    sub(/^#+ /, "", name)
    heading[FILENAME "#" anchor(name)] = 1
  }
  # An entry of a table.
  if (/^\| <a id="/ && !inside) {
    name = $0
    gsub(/^\| <a id="|".*/, "", name)
    heading[FILENAME "#" name] = 1
  }
  if (/^<!-- file: /) made[FILENAME, $3] = 1
  next
}
page && inside { look_up_command($0) }
page {
  if (inside || /^<!-- /) next
  look_up_links($0)
  # What no longer is is the changelog's to say.
  if (FILENAME == "CHANGELOG.md") next
  look_up_files($0)
  look_up_functions($0)
  look_up_code($0)
  if (/^\|/) look_up_row($0)
  look_up_default($0)
  next
}
# Of sources the comments.
match($0, FILENAME ~ /\.(h|cpp)$/ ? "//.*" : "#.*") {
  comment = substr($0, RSTART)
  look_up_files(comment)
  look_up_functions(comment)
  look_up_code(comment)
}
END {
  print checks " names, " faults + 0 " faults"
}

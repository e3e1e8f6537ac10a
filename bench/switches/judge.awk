# SPDX-License-Identifier: MIT
# Puts a column of instructions into a printed table, behind the time, and into the last column what a
# switch is judged by where the meshes do not tell: with instructions it pays by one more in a hundred
# in the mean.
# Usage: awk -v name=SWITCH -v judged='by instructions' -f judge.awk COUNTS PRINTED.md
#        COUNTS: the base's and the switch's, a line for each volume; may be empty

FILENAME != ARGV[2] && FILENAME != "-" {
  ratio = $2 / $1
  product = (volumes++ ? product : 1) * ratio
  dearer += ratio >= 1.01
  next
}
{ gsub(/ +/, " ") }
!/^\| [^|]/ { print; next }
{
  cells = split($0, cell, "|")
  own = ""
  last = cell[cells - 1]
  if (cell[2] ~ /^ switch /) own = " instructions "
  else if (cell[2] ~ /^ -/) own = " ---: "
  else if (index(cell[2], " " name " ") == 1 && last == " no ") {
    if (judged == "by instructions" && volumes) {
      own = sprintf(" %.3f%s", product ^ (1 / volumes), dearer ? " !" dearer " " : " ")
      last = product ^ (1 / volumes) >= 1.01 ? " yes " : " no "
    } else if (judged != "") {
      last = " " judged " "
    }
  }
  printf "|"
  for (n = 2; n < cells - 1; n++) printf "%s|%s", cell[n], n == 4 ? (own == "" ? " " : own) "|" : ""
  print last "|"
}

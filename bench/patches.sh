# SPDX-License-Identifier: MIT
# What bench/mutants and bench/switches have in common: a folder of patches, each with a head of lines
# "KEY: value" above its first "---". To be sourced, with `here`, the folder, and `source`, the tree.
command -v patch >/dev/null || { echo 'no patch here'; exit 77; }

# Prints the value of a key in the head of a patch.
head_of() { sed -n "/^--- /q; s/^$2: //p" "$here/$1.patch"; }
all_patches() { for file in "$here"/*.patch; do basename "$file" .patch; done; }
# Applies a patch to a copy of the tree; with --dry-run it is only tried.
apply() { patch -p1 --fuzz=0 --quiet ${3:+"$3"} -d "$2" <"$here/$1.patch"; }
# Prints a line and returns 1 if the patch does not apply to the sources.
still_applies() {
  apply "$1" "$source" --dry-run || { echo "$1: does not apply; bring it up to date in $here"; return 1; }
}

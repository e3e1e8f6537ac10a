# SPDX-License-Identifier: MIT
# shellcheck shell=sh
# For scripts that check and go on: `holds MESSAGE COMMAND...`, and `all_hold` at the end.
checks=0
faults=0
# The command must succeed.
holds() {
  message=$1
  shift
  checks=$((checks + 1))
  if ! "$@"; then
    echo "FAULT: $message"
    faults=$((faults + 1))
  fi
}
# all_hold LEAST: says how many did; the status is 0 where all did, and at least so many were asked.
all_hold() {
  echo "$checks checks, $faults faults"
  [ "$checks" -ge "$1" ] && [ "$faults" -eq 0 ]
}

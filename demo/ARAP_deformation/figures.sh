#!/usr/bin/env bash
# Runs the commands by which the manual makes its figures, as they are written there,
# in a folder with the models of arap_demo. Lists those whose model is there in figures.txt, a line
# for each argument and an empty one at the end, from which arap_demo draws them side by side. Keeps
# reports, selections and transforms beside the results.
# usage: figures.sh ARAP_DEFORM FOLDER [ITERATIONS]   at most so many ITERATIONS
set -euo pipefail
manual=$(dirname "$0")/../../doc/ARAP_deformation/Paper.txt
program=$1 iterations=${3:-}
commands=$(sed -n 's/^    //p' "$manual") # indented lines are commands
[ -n "$commands" ] || { echo "figures.sh: $manual has no commands" >&2; exit 1; }
cd "$2"
: >figures.txt

arap_deform() { # with a report instead of the picture of this result alone
  local model=$1 options=() output= code=0
  ! [ -f "$model" ] || { printf '%s\n' "$@"; echo; } >>figures.txt
  while [ $# -gt 0 ]; do
    case $1 in
      --image|--color|--view) shift ;;
      --iterations) options+=("$1" "$((iterations && iterations < $2 ? iterations : $2))"); shift ;;
      -o) output=$2; options+=("$1" "$2"); shift ;;
      *) options+=("$1") ;;
    esac
    shift
  done
  if [[ -n $iterations && " ${options[*]} " != *" --iterations "* ]]; then
    options+=(--iterations "$iterations")
  fi
  [[ " ${options[*]} " == *" --save-transform "* ]] ||
    options+=(--save-selection "${output%.*}.sel" --save-transform "${output%.*}.def")
  "$program" "${options[@]}" --report "${output%.*}.json" --quiet || code=$?
  # a model may be missing, but wrong usage is another code
  [ $code = 0 ] || { [ $code = 1 ] && ! [ -f "$model" ]; } ||
    { echo "figures.sh: failed: arap_deform ${options[*]}" >&2; exit 1; }
}

eval "$commands"
[ -s figures.txt ] || { echo "figures.sh: there is no model in $2" >&2; exit 1; }

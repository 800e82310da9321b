#!/bin/sh
# Prints the man page of the command, which help2man makes of its help.
# usage: man_page.sh ARAP_DEFORM VERSION
set -eu
if [ "$1" = --help ]; then # help2man asks: the help in the form that it knows, a command in one line
  help=$("$ARAP_DEFORM" --help) # a pipe would hide its failure
  printf '%s\n' "$help" | sed -e ':join' -e '/\\$/{N;s/ \\\n */ @@ /;b join' -e '}' \
    -e 's/^usage:/Usage:/' -e 's/^  arap_deform/  $ arap_deform/' \
    -e 's/-\([a-z]\) \[ --\([a-z]*\) \]/-\1, --\2/' \
    -e '/^  [a-z]*:/s/\([^ ]\)  \([a-z]*:\)/\1, \2/g' \
    -e 's/^What is held and moved:/Options:\n\n&/' -e 's/^Between key frames/Examples:\n\n&/' \
    -e 's/^The report tells/*Report*\n\n&/' -e 's/^Exit status: /*Exit status*\n\n/'
  exit
fi
command=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
cd "$(dirname "$0")" # help2man takes a path apart at blanks
page=$(ARAP_DEFORM=$command help2man --no-info --version-string="arap_deform $2" \
  --name='deform a mesh as rigidly as possible' ./"$(basename "$0")")
printf '%s\n' "$page" |
  sed -e '/^\.IP$/{N;s/^\.IP\(\n\\f(CW\$ \)/.IP "" 2\1/' -e '}' -e 's/^\\f(CW\$ /\\f(CW/' \
    -e 's/\(\n\\f(CW\)\$ /\1/' -e 's/ @@ / \\e\n.br\n\\ \\ /'

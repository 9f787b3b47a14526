#!/usr/bin/env bash
# Runs the commands in the ```console blocks of a guide, in a folder of their own, and compares what they print with
# what the guide says. A command begins behind "$ "; a here-document belongs to it up to its END.
set -euo pipefail

[[ $# -eq 2 ]] || { echo "usage: $0 GUIDE SUREHIT_QUERY" >&2 && exit 2; }
guide=$(realpath "$1")
PATH="$(dirname "$(realpath "$2")"):$PATH"
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

# shellcheck disable=SC2016  # the marks of a code block
sed -n '/^```console$/,/^```$/{/^```/!p}' "$guide" >said
[[ -s said ]] || exit 0

# Each command is run where it stands, and its output takes the place of what the guide says.
{
  document=false
  while IFS= read -r line; do
    if $document || [[ $line == '$ '* ]]; then
      command=${line#'$ '}
      printf 'cat <<"COMMAND"\n%s\nCOMMAND\n' "$line" >>shown
      printf '%s\n' "$command" >>script
      if [[ $line == *'<<END' ]]; then document=true; fi
      if [[ $line == END ]]; then document=false; fi
      if ! $document; then
        cat shown script
        : >shown
        : >script
      fi
    fi
  done <said
} >all
bash all >printed 2>&1
diff --unified said printed

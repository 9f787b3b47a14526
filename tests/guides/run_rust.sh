#!/usr/bin/env bash
# Compiles a program in Rust, links it to surehit, and compares what it prints with a file.
set -euo pipefail

[[ $# -eq 5 ]] || { echo "usage: $0 EXPECTED RUSTC SOURCE LIBRARY_FOLDER LINK_FLAGS" >&2 && exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
read -ra flags <<<"$5"
"$2" --edition 2021 -L "native=$4" "${flags[@]/#/-Clink-arg=}" -o "$folder/program" "$3"
diff --unified "$1" <(LD_LIBRARY_PATH="$4" "$folder/program")

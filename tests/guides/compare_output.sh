#!/usr/bin/env bash
# Runs a program and compares what it prints with a file.
set -euo pipefail

[[ $# -ge 2 ]] || { echo "usage: $0 EXPECTED PROGRAM [ARGUMENT...]" >&2 && exit 2; }
diff --unified "$1" <("${@:2}")

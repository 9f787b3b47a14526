#!/usr/bin/env bash
# Builds the page, which any static server serves.
set -euo pipefail

usage() {
  cat <<USAGE
usage: $0 [--module FILE] [--packages FOLDER] [FOLDER]

Builds the page into FOLDER/page, by default build/web_picking/page. "npm install" comes before it.

  --module FILE      takes this surehit.wasm, and does not build one
  --packages FOLDER  takes esbuild, three.js and three-mesh-bvh from this node_modules
USAGE
}

fail() {
  echo "error: $1" >&2
  exit 1
}

here=$(dirname "$(readlink -f "$0")")
root=$(readlink -f "$here/../..")
web=$root/collision/bindings/web
module=
packages=$here/node_modules
folder=$root/build/web_picking
while [[ $# -gt 0 ]]; do
  case "$1" in
    -h | --help) usage && exit 0 ;;
    --module | --packages)
      [[ $# -gt 1 ]] || { usage >&2 && exit 2; }
      if [[ $1 == --module ]]; then module=$2; else packages=$2; fi
      shift
      ;;
    -*) usage >&2 && exit 2 ;;
    *) folder=$1 ;;
  esac
  shift
done

[[ -x $packages/.bin/esbuild ]] || fail "there is no esbuild in $packages: npm install gets it"
if [[ -z $module ]]; then
  "$web/build.sh"
  module=$root/build/web/package/surehit.wasm
fi
[[ -f $module ]] || fail "there is no file $module"

cmake -G Ninja -S "$here" -B "$folder/level" -DCMAKE_TOOLCHAIN_FILE="$web/wasm32.cmake" -DCMAKE_BUILD_TYPE=Release
cmake --build "$folder/level"

mkdir -p "$folder/page"
NODE_PATH=$packages "$packages/.bin/esbuild" "$here/src/page.js" --bundle --minify --format=esm --target=es2022 \
  --outfile="$folder/page/page.js" --alias:surehit="$web/surehit.js" --external:node:fs/promises --log-level=warning
cp "$here/index.html" "$here/page.css" "$module" "$folder/level/level.wasm" "$folder/page/"
echo "The page is in $folder/page. Any static server serves it: python3 -m http.server --directory $folder/page"

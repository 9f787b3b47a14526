#!/usr/bin/env bash
# Builds surehit for WebAssembly as an npm package, and prints its size.
set -euo pipefail

usage() {
  cat <<USAGE
usage: $0 [--with-tests] [FOLDER]

Builds the package into FOLDER/package, by default build/web/package. --with-tests builds FOLDER/answer_hash.wasm too, and
joins sources. That compiles faster, and the module is a little larger.
USAGE
}

fail() {
  echo "error: $1" >&2
  exit 1
}

with_tests=OFF
folder=
while [[ $# -gt 0 ]]; do
  case "$1" in
    --with-tests) with_tests=ON ;;
    -h | --help) usage && exit 0 ;;
    -*) usage >&2 && exit 2 ;;
    *) folder=$1 ;;
  esac
  shift
done

here=$(dirname "$(readlink -f "$0")")
folder=${folder:-$here/../../../build/web}

missing=()
for program in clang++-19 wasm-ld-19 cmake ninja; do
  command -v "$program" >/dev/null || missing+=("$program")
done
[[ -e /usr/lib/wasm32-wasi/libc.a ]] || missing+=("wasi-libc")
[[ -e /usr/lib/wasm32-wasi/libc++.a ]] || missing+=("libc++ for wasm32")
[[ ${#missing[@]} -eq 0 ]] || fail "missing: ${missing[*]}; .ci/install_packages.sh library web installs them"

cmake -G Ninja -S "$here" -B "$folder" -DCMAKE_TOOLCHAIN_FILE="$here/wasm32.cmake" -DCMAKE_BUILD_TYPE=Release \
  -DSUREHIT_WEB_TESTS=$with_tests -DCMAKE_UNITY_BUILD=$with_tests
cmake --build "$folder"

mkdir -p "$folder/package"
cp "$folder/surehit.wasm" "$here"/{surehit.js,memory.js,surehit.d.ts,surehit_three.js,surehit_three.d.ts} \
  "$here"/{package.json,package-lock.json,README.md} "$here/../../../LICENSE" "$folder/package/"
bytes=$(stat --format=%s "$folder/package/surehit.wasm")
echo "surehit.wasm: $bytes bytes, $(gzip --best --stdout "$folder/package/surehit.wasm" | wc --bytes) gzipped"

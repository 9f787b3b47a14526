#!/usr/bin/env bash
# Builds the page of examples/web_picking, and drives it in a browser. 77 says that npm could not get what it needs.
set -euo pipefail

here=$(dirname "$(readlink -f "$0")")
example=$here/../../examples/web_picking
mkdir -p page_build/test
cp "$example"/package.json "$example"/package-lock.json page_build/
(cd page_build && npm ci --no-audit --no-fund) || exit 77
"$example/build.sh" --module package/surehit.wasm --packages "$PWD/page_build/node_modules" "$PWD/page_build"
cp "$here/page_test.mjs" "$here/oracle.mjs" page_build/test/
SUREHIT_CHROMIUM=$2 "$1" page_build/test/page_test.mjs

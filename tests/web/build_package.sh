#!/usr/bin/env bash
# Builds the npm package into a folder, with the tests in it, which then import it by its name.
set -euo pipefail

here=$(dirname "$(readlink -f "$0")")
"$here/../../collision/bindings/web/build.sh" --with-tests "$1"
rm -rf "$1/package/test"
mkdir "$1/package/test"
cp "$here"/*.mjs "$1/package/test/"

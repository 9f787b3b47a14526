#!/usr/bin/env bash
# Gets three.js, in the version of package-lock.json, and compares it with surehit. 77 says that npm could not get it.
set -euo pipefail

cd package
npm ci --no-audit --no-fund || exit 77
"$1" test/parity_test.mjs

#!/usr/bin/env bash
# Installs those packages of packages.txt that the named parts need and that are not there yet.
set -euo pipefail

list="$(dirname "$(readlink -f "$0")")/packages.txt"

fail() {
  echo "error: $1" >&2
  exit 1
}

[[ $# -gt 0 ]] || fail "say what to install for: library, examples, tests, fuzz, benchmarks, languages, python, python_tests, mpi, web, npm, browser, gpu, aarch64, windows or develop"

missing=()
for part in "$@"; do
  mapfile -t packages < <(awk -v part="$part" '$2 == part && !/^#/ { print $1 }' "$list")
  [[ ${#packages[@]} -gt 0 ]] || fail "no package in $list is for '$part'"
  for package in "${packages[@]}"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [[ $status == installed ]] || missing+=("$package")
  done
done

if [[ ${#missing[@]} -eq 0 ]]; then
  echo "All packages for $* are installed."
  exit 0
fi

command -v apt-get >/dev/null || fail "no apt-get here to install what is missing: ${missing[*]}"
as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || fail "neither root nor sudo, so ask an administrator to install: ${missing[*]}"
  as_root=(sudo)
fi

echo "Installing: ${missing[*]}"
"${as_root[@]}" apt-get update -qq || fail "apt-get update failed"
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${missing[@]}" ||
  fail "apt-get could not install: ${missing[*]}"

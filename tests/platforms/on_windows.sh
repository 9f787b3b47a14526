#!/usr/bin/env bash
# Compiles surehit and its tests for 64-bit Windows, and runs them in Wine, on Debian: as root or with sudo, which
# install the compiler and Wine. Each instruction set that this machine has gets a build of its own. Succeeds if all
# tests pass and the answers are the published ones.
set -euo pipefail

cd "$(dirname "$(readlink -f "$0")")/../.."

.ci/install_packages.sh windows tests library

# The processor that is compiled for, and the flag of /proc/cpuinfo that says whether this one can do as much.
for processor in x86-64:sse2 westmere:aes haswell:avx2 skylake-avx512:avx512dq; do
  name=${processor%:*}
  if ! grep -qw "${processor#*:}" /proc/cpuinfo; then
    echo "left out: $name, which this machine is not"
    continue
  fi
  echo "== $name"
  cmake -D GENERATOR=Ninja -D PARALLEL="$(nproc)" -D TEST_FOLDER="$PWD/build/windows/$name" -D FLAGS="-march=$name" \
    -D OPTIONS="-DCMAKE_TOOLCHAIN_FILE=$PWD/tests/platforms/mingw64.cmake -DSUREHIT_PLATFORM_ALL_TESTS=ON" \
    -P tests/platforms/build_and_test.cmake
done

#!/usr/bin/env bash
# Compiles surehit for 64-bit ARM and asks it the hard questions in an emulator, on Debian: as root or with sudo, which
# install the compiler and the emulator. Succeeds if the answers are the published ones.
set -euo pipefail

cd "$(dirname "$(readlink -f "$0")")/../.."
folder=$PWD/build/aarch64

.ci/install_packages.sh aarch64

# Highway for ARM is unpacked beside the build, so that the machine's own packages stay of one architecture.
arm_root=$folder/root
if [[ ! -d $arm_root ]]; then
  mkdir -p "$folder/apt/lists/partial" "$folder/apt/archives/partial"
  arm_apt=(apt-get -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o APT::Sandbox::User=root
    -o Dir::State::Lists="$folder/apt/lists" -o Dir::Cache="$folder/apt")
  "${arm_apt[@]}" update
  (cd "$folder/apt/archives" && "${arm_apt[@]}" download libhwy-dev libhwy1)
  for package in "$folder"/apt/archives/*.deb; do dpkg-deb --extract "$package" "$arm_root"; done
fi

cmake -G Ninja -S tests/package/consumer -B "$folder/build" -DSUREHIT_SOURCE_FOLDER="$PWD" -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_CXX_COMPILER=aarch64-linux-gnu-g++ \
  -Dhwy_DIR="$arm_root/usr/lib/aarch64-linux-gnu/cmake/hwy"
cmake --build "$folder/build"
for program in consumer answer_hash; do
  qemu-aarch64 -L /usr/aarch64-linux-gnu -E LD_LIBRARY_PATH="$arm_root/usr/lib/aarch64-linux-gnu" "$folder/build/$program"
done

#!/usr/bin/env bash
# Tests and measures surehit::gpu on a device of this machine, on Debian: as root or with sudo, which install what is
# missing. Succeeds if all tests of the device pass. The tables are for the page "Choosing CPU or GPU". Sixteen cores
# need some minutes, most of them to compile.
set -euo pipefail

cd "$(dirname "$(readlink -f "$0")")/../.."

usage() {
  cat <<USAGE
usage: $0 NAME [OPTION...]

NAME is a part of the device's name. Without one, this lists the devices. Options are those of surehit_benchmark, which
measures once with them. Without any, it measures the built-in level, a terrain, a world of cubes and a town.
USAGE
}

fail() {
  echo "error: $1" >&2
  exit 1
}

stage() { printf '\n== %s  (%d min %d s since the start)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }

if [[ ${1:-} == -h || ${1:-} == --help ]]; then usage && exit 0; fi
name=${1:-}
shift || true

stage "Packages"
.ci/install_packages.sh library examples tests gpu || echo "going on with what is there"

stage "Building"
folder=build/gpu
tests=(gpu_batches_test gpu_buffer_batch_test gpu_collider_test gpu_commands_test gpu_device_needs_test gpu_device_test gpu_memory_test
  gpu_placed_path_test gpu_scene_buffer_test gpu_scene_failures_test gpu_scene_test gpu_shares_test gpu_slots_test
  gpu_tree_test)
mkdir -p build
# One instruction set is compiled, that of this machine.
cmake --preset release -B "$folder" -D SUREHIT_GPU=ON -D CMAKE_CXX_FLAGS="-march=native -DHWY_COMPILE_ONLY_STATIC" \
  >"$folder.log" 2>&1 || { cat "$folder.log" && fail "CMake failed"; }
cmake --build "$folder" --parallel "$(nproc)" --target surehit_benchmark "${tests[@]}" surehit-query >"$folder.log" 2>&1 ||
  { tail -n 50 "$folder.log" && fail "the build failed"; }

benchmark=$folder/tests/benchmarks/surehit_benchmark
stage "Device"
if [[ -z $name ]]; then
  # A name that no device has makes it say which there are.
  "$benchmark" --quick --table gpu --gpu-name "a device of any name"
  usage
  exit 2
fi

stage "Tests on $name"
printf '%s\n' "${tests[@]}" |
  xargs -P 4 -I '{}' env "SUREHIT_TEST_GPU=$name" "$folder/tests/collision/gpu/{}" --gtest_brief=1 ||
  fail "tests have failed"

measure() {
  stage "surehit_benchmark $*"
  "$benchmark" --gpu-name "$name" --csv "$folder-$((++runs)).csv" "$@"
}
runs=0
if [[ $# -gt 0 ]]; then
  measure "$@"
else
  measure --rounds 3 --table gpu --set short --set near
  measure --rounds 3 --table gpu --set edge --set edge_end --set in_plane --batch 100000
  measure --rounds 3 --table gpu --set short --set near --batch 1000000 --uneven --mesh terrain --mesh voxels
  measure --rounds 3 --table gpu_scene --set short --set near --batch 1000000 --scene town
fi
stage "Done: all figures are in $folder-*.csv"

#!/usr/bin/env bash
# Installs what is missing, builds surehit and runs its tests. The last line says how many passed and how many failed.
set -uo pipefail

usage() {
  cat <<USAGE
usage: $0 [--quick | --full]

Without options: all tests in Release with GCC, with a fifth of the random cases, but 100,000 pairs of each family of
moving shapes; and a twentieth of the cases with Clang under AddressSanitizer and UndefinedBehaviorSanitizer, of the
library, surehit-query and the readers of meshes. Lanes are left out for SSE4, and for AVX-512 on a machine without it:
two tests of the package compile those. Examples and benchmarks are optimized less.

  --quick   Release with Clang alone, a tenth of the cases: of the library and the examples alone
  --full    all random cases in Release with GCC, for all instruction sets and with examples and benchmarks optimized in
            full, code for compilers that lack what GCC has, all examples under sanitizers, and besides a tenth of the
            cases in Release with Clang

SUREHIT_TEST_PERCENT sets another share than a fifth.
USAGE
}

quick=false
full=false
percent=20  # The tests kill nearly all mutants with a fifth.
sets_left_out="HWY_SSSE3|HWY_AVX3_DL"
program_optimization=-Og
case "${1:-}" in
  "") ;;
  --quick) quick=true ;;
  --full) full=true && percent=100 && program_optimization= ;;
  -h | --help) usage && exit 0 ;;
  *) usage >&2 && exit 2 ;;
esac

# Each instruction set takes minutes to compile. A test of the package has SSE4 alone, and asks the hard questions of it.
# The Debian package has all sets, by Clang. What the machine lacks could not run.
if ! $full; then
  sets_left_out+="|HWY_SSE4"
  grep -qs '^flags.* avx512vl ' /proc/cpuinfo || sets_left_out+="|HWY_AVX3"
fi

cd "$(dirname "$(readlink -f "$0")")/.." || exit 1
export CMAKE_CXX_COMPILER_LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER:-$PWD/tests/compiler_launcher.sh}

passed=0
failed=0
skipped=0
failures=()
left_out=$(mktemp)

record_failure() {
  failed=$((failed + $1))
  failures+=("$2")
}

stage() { printf '\n== %s  (%d min %d s since the start)\n' "$1" $((SECONDS / 60)) $((SECONDS % 60)); }

finish() {
  echo
  for failure in "${failures[@]}"; do echo "failed: $failure"; done
  sed 's/^/left out: /' "$left_out"
  rm -f "$left_out"
  if [[ $skipped -gt 0 ]]; then echo "$skipped skipped: those that ctest lists above as not run"; fi
  echo "$passed passed, $failed failed"
  [[ $failed -eq 0 && $passed -gt 0 ]]
  exit
}

# A step that is no test counts as one failed test if it fails.
step() {
  "$@" && return
  record_failure 1 "$*"
  return 1
}

# build PRESET OPTION...: sources share translation units, which takes less time.
build() {
  local preset=$1
  shift
  step cmake --preset "$preset" -D SUREHIT_JOIN_TESTS=ON -D CMAKE_UNITY_BUILD=ON -D CMAKE_UNITY_BUILD_BATCH_SIZE=20 "$@" &&
    step cmake --build --preset "$preset"
}

# build_with_gcc ON|OFF: with examples and tests, or the library alone, which needs no package but its own.
build_with_gcc() {
  local all=$1 linker=
  [[ $all == ON ]] && linker=-fuse-ld=lld
  CXX=g++ build release -D "SUREHIT_BUILD_EXAMPLES=$all" -D "SUREHIT_BUILD_TESTS=$all" \
    -D "CMAKE_EXE_LINKER_FLAGS=$linker" -D "CMAKE_MODULE_LINKER_FLAGS=$linker" -D "CMAKE_SHARED_LINKER_FLAGS=$linker" \
    -D "SUREHIT_INSTRUCTION_SETS_LEFT_OUT=$sets_left_out" -D "SUREHIT_PROGRAM_OPTIMIZATION=$program_optimization" \
    -D "SUREHIT_TEST_PLATFORMS=$full"
}

run_tests() {
  local preset=$1 output status counts failed_here total skipped_here
  shift
  output=$(mktemp)
  # Two more than there are cores, since some tests wait: for each other's answers, or for a device that has none.
  ctest --preset "$preset" --parallel "$(($(nproc) + 2))" "$@" 2>&1 | tee "$output"
  status=${PIPESTATUS[0]}
  counts=$(sed -nE 's/^[0-9]+% tests passed, ([0-9]+) tests? failed out of ([0-9]+)$/\1 \2/p' "$output")
  skipped_here=$(grep -c '\*\*\*Skipped' "$output")
  rm -f "$output"

  read -r failed_here total <<<"${counts:-0 0}"
  skipped=$((skipped + skipped_here))
  passed=$((passed + total - failed_here - skipped_here))
  if [[ $failed_here -gt 0 ]]; then
    record_failure "$failed_here" "$failed_here tests of $preset"
  elif [[ $status -ne 0 || $total -eq 0 ]]; then
    record_failure 1 "ctest --preset $preset"
  fi
}

# install_part PART TEXT: the text says what is left out if the packages of this part cannot be had. CMake builds without it.
install_part() { .ci/install_packages.sh "$1" || echo "$2" >>"$left_out"; }

has_npm() { command -v npm >/dev/null; }
has_browser() { command -v chromium || command -v chromium-browser || command -v google-chrome; } >/dev/null

# All at once takes half as long as part by part.
install_all() {
  local parts=(examples tests benchmarks mpi gpu languages python python_tests web)
  has_npm || parts+=(npm)
  has_browser || parts+=(browser)
  .ci/install_packages.sh "${parts[@]}"
}

# These say what could not be had. What is there already takes no time.
install_for_tests() {
  step .ci/install_packages.sh library examples tests benchmarks || finish
  install_part mpi "visibility_bake with MPI: its package cannot be installed"
  install_part gpu "batches on a GPU: Vulkan's headers, glslang or lavapipe cannot be installed"
}

install_for_packages() {
  install_part languages "the guide's programs in Rust and C#: their compilers cannot be installed"
  install_part python "the package for Python: NumPy or pip cannot be installed"
  install_part python_tests "the pictures and types of the package for Python: Matplotlib or mypy cannot be installed"
  install_part web "WebAssembly: its packages cannot be installed"
  has_npm || install_part npm "the comparison with three.js: npm cannot be installed"
  has_browser || install_part browser "the page web_picking: no Chromium can be installed"
}

if $quick; then
  stage "Packages"
  install_for_tests
  stage "Clang, Release: building"
  build quick || finish
  stage "Clang, Release: testing"
  run_tests quick
  finish
fi

stage "Packages of the library"
step .ci/install_packages.sh library || finish
stage "GCC, Release: building the library, while other packages are installed"
output_of_install=$(mktemp)
install_all >"$output_of_install" 2>&1 &
build_with_gcc OFF || finish
stage "Packages of tests"
wait
cat "$output_of_install"
rm -f "$output_of_install"
install_for_tests
install_for_packages
stage "GCC, Release: building"
build_with_gcc ON || finish
stage "GCC, Release: testing"
SUREHIT_TEST_PERCENT=${SUREHIT_TEST_PERCENT:-$percent} run_tests release

stage "Clang, AddressSanitizer and UndefinedBehaviorSanitizer: building"
if build asan-ubsan -D "SUREHIT_ALL_EXAMPLES=$full"; then
  stage "Clang, AddressSanitizer and UndefinedBehaviorSanitizer: testing a twentieth of the cases"
  run_tests asan-ubsan
fi

if $full; then
  stage "Clang, Release: building"
  if build clang; then
    stage "Clang, Release: testing a tenth of the cases"
    SUREHIT_TEST_PERCENT=10 run_tests clang --label-exclude package
  fi
fi

finish

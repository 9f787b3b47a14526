#!/usr/bin/env bash
# Fuzzes one target, or all one after the other. Exit status: 0 without a finding, 1 with one, 2 for wrong usage.
set -uo pipefail

usage() {
  cat <<USAGE
usage: $0 --seconds N [--target T] [--corpus FOLDER]   libFuzzer, with Clang's sanitizers
       $0 --cases N [--seed S] [--target T]            bytes drawn from a seed, with GCC alone
       $0 --merge FOLDER --target T                    makes the repository's corpus the fewest files of it and of
                                                       FOLDER that reach as much as all of them
       $0 --replay FILE --target T                     one input, with GCC alone

  T        one of: ${targets[*]}
  --seed   of the first case (default 1); each seed draws other cases
  --corpus where libFuzzer keeps what it finds to reach more (default build/fuzz-corpus/T); it begins with
           tests/fuzz/corpus/T as well

Inputs with a finding are kept in build/fuzz-findings/T, libFuzzer's in a smaller version too, and the command that
replays one is printed.
USAGE
}

targets=(pair shape collider c_interface mesh_readers command_line saved_file)
wanted=("${targets[@]}")
mode=
seed=1
corpus=
while [[ $# -gt 0 ]]; do
  case "$1" in
    -h | --help) usage && exit 0 ;;
  esac
  [[ $# -ge 2 ]] || { usage >&2 && exit 2; }
  case "$1" in
    --seconds | --cases | --merge | --replay) mode=$1 amount=$2 ;;
    --target) wanted=("$2") ;;
    --corpus) corpus=$(realpath -m "$2") ;;
    --seed) seed=$2 ;;
    *) usage >&2 && exit 2 ;;
  esac
  shift 2
done
[[ -n $mode && " ${targets[*]} " == *" ${wanted[0]} "* ]] || { usage >&2 && exit 2; }
case "$mode" in
  --merge | --replay)
    [[ ${#wanted[@]} -eq 1 && -e $amount ]] || { usage >&2 && exit 2; }
    amount=$(realpath "$amount")
    ;;
  *) [[ $amount$seed =~ ^[0-9]+$ ]] || { usage >&2 && exit 2; } ;;
esac

self=$(readlink -f "$0")
cd "$(dirname "$self")/../.." || exit 1
root=$PWD

build() {
  cmake --preset "$1" >/dev/null && cmake --build --preset "$1" --target "${wanted[@]/#/fuzz_}"
}

# Short stacks and a small quarantine: else most of the time goes into remembering who allocated what.
export ASAN_OPTIONS=malloc_context_size=3:quarantine_size_mb=32${ASAN_OPTIONS:+:$ASAN_OPTIONS}

parts=(library examples tests)
preset=release
if [[ $mode == --seconds || $mode == --merge ]]; then
  parts+=(fuzz)
  preset=fuzz
else
  export CXX=${CXX:-g++}
fi
.ci/install_packages.sh "${parts[@]}" || exit 1
build "$preset" || exit 1

# A text may grow long; a pair or a mesh says all it has to say in less.
limits_of() {
  case "$1" in
    pair | shape) echo -max_len=128 ;;
    collider) echo -max_len=192 ;;
    c_interface) echo -max_len=1024 ;;
    mesh_readers) echo -max_len=2048 -malloc_limit_mb=64 "-dict=$root/tests/fuzz/mesh_readers.dict" ;;
    saved_file) echo -max_len=4096 -malloc_limit_mb=64 ;;
    command_line) echo -max_len=1024 -malloc_limit_mb=64 "-dict=$root/tests/fuzz/command_line.dict" ;;
  esac
}

tell_of() {
  local target=$1 findings=$2 file
  for file in "$findings"/*; do
    [[ -f $file ]] || continue
    echo "finding: $file"
    echo "replay:  $0 --target $target --replay $file"
  done
}

minimize() {
  local program=$1 file=$2
  "$program" -minimize_crash=1 -max_total_time=60 -exact_artifact_path="$file-smaller" "$file" >/dev/null 2>&1
}

run() {
  local target=$1
  local program=$root/build/$preset/tests/fuzz/fuzz_$target
  local given=$root/tests/fuzz/corpus/$target
  local findings=$root/build/fuzz-findings/$target
  mkdir -p "$findings" && cd "$findings" || return 1
  echo "== $target"
  case "$mode" in
    --cases) "$program" draw "$amount" "$seed" "$given" || { tell_of "$target" "$findings" && return 1; } ;;
    --replay) "$program" replay "$amount" ;;
    --merge)
      local chosen
      chosen=$(mktemp -d)
      "$program" -set_cover_merge=1 -use_counters=0 "$chosen" "$given" "$amount" || return 1
      rm -f "$given"/*
      mv "$chosen"/* "$given"/
      rmdir "$chosen"
      ;;
    --seconds)
      local grown=${corpus:-$root/build/fuzz-corpus/$target} limits
      read -ra limits < <(limits_of "$target")
      mkdir -p "$grown"
      "$program" -max_total_time="$amount" -timeout=60 -rss_limit_mb=2048 -print_final_stats=1 \
        -artifact_prefix="$findings/" "${limits[@]}" "$grown" "$given" && return
      local file
      for file in "$findings"/{crash,leak,oom,timeout}-*; do
        if [[ -f $file && $file != *-smaller && ! -f $file-smaller ]]; then minimize "$program" "$file"; fi
      done
      tell_of "$target" "$findings"
      return 1
      ;;
  esac
}

status=0
for target in "${wanted[@]}"; do (run "$target") || status=1; done
exit $status

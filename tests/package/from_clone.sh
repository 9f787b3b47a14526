#!/usr/bin/env bash
# Follows the pages as a newcomer would, on a Debian 12 with nothing on it: from `git clone` to a hit. Each line and each
# program is that of a page, as printed. Says how long each way takes. Needs root, debootstrap and a network.
set -euo pipefail

usage() {
  cat <<USAGE
usage: $0 [WAY...]

  cpp      examples/guides/first_hit.md
  c        examples/guides/other_languages.md
  python   collision/bindings/python/README.md

Without a WAY, all three. What is committed is cloned. The systems and logs are in build/from_clone. MIRROR names another
mirror of Debian.
USAGE
}

fail() {
  echo "error: $1" >&2
  exit 1
}

ways=()
for argument in "$@"; do
  case "$argument" in
    cpp | c | python) ways+=("$argument") ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
  esac
done
[[ ${#ways[@]} -gt 0 ]] || ways=(cpp c python)

[[ $(id -u) -eq 0 ]] || fail "a system is installed and entered by root"
command -v debootstrap >/dev/null || fail "no debootstrap here: apt-get install debootstrap"
script=$(readlink -f "$0")
# What is mounted in a namespace of its own is gone when the script ends, in whichever way.
if [[ -z ${SUREHIT_IN_NAMESPACE:-} ]]; then
  SUREHIT_IN_NAMESPACE=1 exec unshare --mount --propagation private "$script" "$@"
fi
sources="$(dirname "$script")/../.."
sources=$(readlink -f "$sources")
folder="$sources/build/from_clone"
base="$folder/debian"
mkdir -p "$folder"

# Prints a code block of a page: the one with this number among those of its language.
block() {
  awk -v fence="\`\`\`$2" -v number="$3" '
    inside && /^```$/ { exit }
    inside { print }
    $0 == fence && ++count == number { inside = 1 }' "$sources/$1"
}

# Prints a line of a script that writes a block to a file.
written_block() {
  printf 'cat >%s <<"END_OF_BLOCK"\n%s\nEND_OF_BLOCK\n' "$4" "$(block "$1" "$2" "$3")"
}

# Prints what a newcomer types, and the name of the page's block that says what is printed in the end.
script_of() {
  local page
  case "$1" in
    cpp)
      page=examples/guides/first_hit.md
      echo "mkdir game && cd game && git clone --quiet /srv/surehit"
      block $page sh 1
      written_block $page cmake 1 CMakeLists.txt
      written_block $page cpp 1 main.cpp
      block $page sh 2
      ;;
    c)
      page=examples/guides/other_languages.md
      echo "git clone --quiet /srv/surehit && cd surehit"
      block $page sh 1
      echo "mkdir ../game && cd ../game"
      written_block $page c 1 main.c
      block $page sh 2
      ;;
    python)
      page=collision/bindings/python/README.md
      echo "git clone --quiet /srv/surehit && cd surehit"
      block $page sh 1
      written_block $page python 1 hit.py
      echo "surehit-venv/bin/python hit.py"
      ;;
  esac
}

page_of() {
  case "$1" in
    cpp) echo examples/guides/first_hit.md ;;
    c) echo examples/guides/other_languages.md ;;
    python) echo collision/bindings/python/README.md ;;
  esac
}

# Prints how long all commands so far have kept a core busy. On a machine that does other work too, the way itself takes
# longer than on one that does not.
processor_seconds() {
  local ticks
  read -r -a ticks <<<"$(sed 's/^.*) //' "/proc/$$/stat")"
  echo $(((ticks[13] + ticks[14]) / $(getconf CLK_TCK)))
}

# A bare system, on which someone has installed git and sudo before.
if [[ ! -e "$folder/debian_is_complete" ]]; then
  rm -rf "$base"
  echo "Installing a bare Debian 12 ..."
  debootstrap --variant=minbase --include=ca-certificates,git,sudo bookworm "$base" \
    "${MIRROR:-http://deb.debian.org/debian}" >"$folder/debootstrap.log" 2>&1 || fail "see $folder/debootstrap.log"
  echo 'APT::Get::Assume-Yes "true";' >"$base/etc/apt/apt.conf.d/90assume-yes"
  touch "$folder/debian_is_complete"
fi
cp /etc/resolv.conf "$base/etc/resolv.conf"

failed=0
for way in "${ways[@]}"; do
  root="$folder/$way"
  rm -rf "$root"
  mkdir -p "$root/above" "$root/work" "$root/system"
  mount -t overlay -o "lowerdir=$base,upperdir=$root/above,workdir=$root/work" overlay "$root/system"
  mount -t proc proc "$root/system/proc"
  mount --rbind /dev "$root/system/dev"
  git clone --quiet --bare "$sources" "$root/system/srv/surehit"
  git config --file "$root/system/root/.gitconfig" safe.directory '*'
  { echo "set -ex" && script_of "$way"; } >"$root/system/root/typed"

  run=(env -i HOME=/root LC_ALL=C.UTF-8 PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
    DEBIAN_FRONTEND=noninteractive chroot "$root/system" bash -c)
  "${run[@]}" "apt-get update -qq" >"$folder/$way.log" 2>&1 || fail "no list of packages: see $folder/$way.log"
  block "$(page_of "$way")" text 1 >"$root/said"
  begin=$SECONDS
  before=$(processor_seconds)
  "${run[@]}" "cd /root && bash typed" >"$root/printed" 2>>"$folder/$way.log" || true
  seconds=$((SECONDS - begin))
  took="$((seconds / 60)) min $((seconds % 60)) s, with $(($(processor_seconds) - before)) s of one core"
  cat "$root/printed" >>"$folder/$way.log"
  if tail -n "$(wc -l <"$root/said")" "$root/printed" | diff "$root/said" - >>"$folder/$way.log"; then
    echo "$way: a hit after $took"
  else
    echo "$way: failed after $took, see $folder/$way.log"
    failed=1
  fi
  umount --recursive "$root/system"
  rm -rf "$root"
done
exit $failed

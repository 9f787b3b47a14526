#!/usr/bin/env bash
# Builds surehit and four examples that draw, runs them, and says where the pictures are.
set -euo pipefail

if [[ $# -gt 0 ]]; then
  echo "usage: $0    (takes no arguments; the pictures go to build/pictures)" >&2
  exit 2
fi

cd "$(dirname "$(readlink -f "$0")")/.."
pictures="$PWD/build/pictures"
programs="build/quickstart/examples"

stage() { printf '\n== %s\n' "$*"; }

stage "Packages"
.ci/install_packages.sh library examples

stage "Building the library and the examples that draw (Release)"
cmake --preset quickstart
cmake --build --preset quickstart

mkdir -p "$pictures"
stage "line_of_sight: what can be seen from one point of a level"
"$programs/line_of_sight/line_of_sight" -o "$pictures/line_of_sight.png" --csv "$pictures/line_of_sight.csv"

stage "game_physics: fast points in a room of thin walls"
"$programs/game_physics/game_physics" -o "$pictures/game_physics.png"

stage "moving_platforms: bullets and debris among lifts, doors and a train"
"$programs/moving_platforms/moving_platforms" -o "$pictures/moving_platforms.png"

stage "render: a sphere of glass and a diffuse one, by rays"
"$programs/render/render" -o "$pictures/render.png"

stage "Done. The pictures:"
ls -1 "$pictures/line_of_sight.png" "$pictures/game_physics.png" "$pictures/moving_platforms.png" "$pictures/render.png"

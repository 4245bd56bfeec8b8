#!/usr/bin/env bash
# Renders the Cornell box: installs what is missing, builds the glint program, and writes cornell_box.exr and
# cornell_box.png into the current directory. Further arguments go to `glint render`, such as --spp 256.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/dependencies.sh"

[[ -w . ]] || glint_die "cannot write pictures to $PWD: go to a directory that is yours"
glint_require_build
glint_say "building the glint program"
glint_configure release
glint_build release glint_program

glint_say "rendering the Cornell box"
started=$SECONDS
"$glint_root/build/release/bin/glint" render "$glint_root/examples/scenes/cornell_box.json" \
  -o cornell_box.exr -o cornell_box.png "$@"
glint_say "done in $((SECONDS - started)) s"
printf '%s\n' "$PWD/cornell_box.exr" "$PWD/cornell_box.png"

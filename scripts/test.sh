#!/usr/bin/env bash
# Runs every test: installs what is missing, builds everything, and calls ctest. Further arguments go to ctest, such
# as -R bvh.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
# shellcheck source=scripts/dependencies.sh
source "$here/dependencies.sh"

glint_require_build
glint_say "building the tests"
glint_configure release
glint_build release
ctest --test-dir "$glint_root/build/release" --output-on-failure --parallel "$(nproc)" "$@"

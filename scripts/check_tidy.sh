#!/usr/bin/env bash
# clang-tidy finds nothing in the headers and the examples. One unit a folder of headers, which includes them all; what
# templates do when used shows in the examples.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/dependencies.sh
source scripts/dependencies.sh

glint_configure clang
units=build/clang/tidy
mkdir -p "$units"
rm -f "$units"/*.cpp
while read -r header; do
  folder="${header#include/glint/}"
  echo "#include <${header#include/}>" >>"$units/${folder%%[/.]*}.cpp"
done < <(git ls-files --cached --others --exclude-standard 'include/glint/*.hpp')

# The include directories of all targets, as CMake found them.
flags=(-std=c++20 -DGLINT_SOURCE_DIR=\"\")
while read -r flag; do
  flags+=("${flag%% *}" "${flag#* }")
done < <(grep -Eo -- '-(isystem |I)[^ "]+' build/clang/compile_commands.json | sed 's/^-I/-I /' | sort -u)

tool=clang-tidy-14
command -v "$tool" >/dev/null || tool=clang-tidy
check() {
  local unit="$1"
  shift
  "$tool" --quiet "$unit" -- "$@" 2>&1 | grep -Ev '^[0-9]+ warnings? (generated|treated)' || true
}
export -f check
export tool
findings="$({ ls "$units"/*.cpp && git ls-files 'examples/*.cpp'; } |
  xargs -P "$(nproc)" -I '{}' bash -c 'check "$@"' _ '{}' "${flags[@]}")"
if grep -E '(error|warning): ' <<<"$findings"; then
  glint_die "clang-tidy found what stands above"
fi
glint_say "nothing found"

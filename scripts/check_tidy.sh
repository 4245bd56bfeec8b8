#!/usr/bin/env bash
# clang-tidy, and Clang with all the warnings that are errors here, find nothing in the headers, all included by one
# unit, and in the examples, where templates are used.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/dependencies.sh
source scripts/dependencies.sh

glint_configure asan-ubsan
unit=build/asan-ubsan/every_header.cpp
git ls-files --cached --others --exclude-standard 'include/glint/*.hpp' | sed 's|include/\(.*\)|#include <\1>|' >"$unit"

# The include directories of all targets, as CMake found them.
flags=(-std=c++20 -DGLINT_SOURCE_DIR=\"\" -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror)
while read -r flag; do
  flags+=("${flag%% *}" "${flag#* }")
done < <(grep -Eo -- '-(isystem |I)[^ "]+' build/asan-ubsan/compile_commands.json | sed 's/^-I/-I /' | sort -u)

tool=clang-tidy-14
command -v "$tool" >/dev/null || tool=clang-tidy
check() {
  local unit="$1"
  shift
  "$tool" --quiet "$unit" -- "$@" 2>&1 | grep -Ev '^[0-9]+ warnings? (generated|treated)' || true
}
export -f check
export tool
findings="$({ echo "$unit" && git ls-files 'examples/*.cpp'; } |
  xargs -P "$(nproc)" -I '{}' bash -c 'check "$@"' _ '{}' "${flags[@]}")"
if grep -E '(error|warning): ' <<<"$findings" | sed "s|$PWD/||" | sort -u; then
  glint_die "clang-tidy found what stands above"
fi
glint_say "nothing found"

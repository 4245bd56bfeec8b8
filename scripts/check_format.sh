#!/usr/bin/env bash
# Every source is formatted as clang-format 14 formats it with .clang-format; `check_format.sh --fix` does so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tool=clang-format-14
command -v "$tool" >/dev/null || tool=clang-format
mode=(--dry-run --Werror)
[[ "${1:-}" != --fix ]] || mode=(-i)
git ls-files -z --cached --others --exclude-standard '*.hpp' '*.cpp' | xargs -0 "$tool" "${mode[@]}"

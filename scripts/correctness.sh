#!/usr/bin/env bash
# Regenerates the tables of docs/explanation/correctness.md: builds and runs build/release/bin/correctness, which takes
# some minutes. With --quick, and a page that is left alone, a fiftieth of the samples.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=scripts/dependencies.sh
source scripts/dependencies.sh

page=docs/explanation/correctness.md
glint_require_build
glint_configure release
glint_build release correctness
if [[ ${1:-} == --quick ]]; then
  build/release/bin/correctness --quick
  exit
fi
tables=$(mktemp)
trap 'rm -f "$tables"' EXIT
build/release/bin/correctness | tee "$tables"
sed -i -e '/^<!-- tables: begin -->$/,/^<!-- tables: end -->$/{//!d}' -e "/^<!-- tables: begin -->\$/r $tables" "$page"
echo "wrote the tables of $page"

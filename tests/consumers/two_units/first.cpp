// SPDX-License-Identifier: MIT
#include "every_header.hpp"

const glint::Version* version_in_second_unit();

/// One program, one version object: an `inline` forgotten in a header would end in duplicates here, or at the linker.
int main() {
  return version_in_second_unit() == &glint::version ? 0 : 1;
}

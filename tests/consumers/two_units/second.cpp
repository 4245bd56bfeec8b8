// SPDX-License-Identifier: MIT
#include "every_header.hpp"

const glint::Version* version_in_second_unit() {
  return &glint::version;
}

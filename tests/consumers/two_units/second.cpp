// SPDX-License-Identifier: MIT
#include "hits.hpp"

const glint::Version* version_in_second_unit() {
  return &glint::version;
}

int hits_in_second_unit() {
  return hits_in_this_unit();
}

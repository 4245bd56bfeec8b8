// SPDX-License-Identifier: MIT
#include <glint/core/index.hpp>  // first, so the header proves it stands alone

#include <cstdint>

#include <support/catch.hpp>

namespace test_core_index {

TEST_CASE("index: none is the largest value of its type, so no container is long enough to hold it", "[core][index]") {
  CHECK(glint::none<std::uint16_t> == 0xFFFFU);
  CHECK(glint::none<std::uint32_t> == 0xFFFFFFFFU);
  CHECK(glint::none<std::uint64_t> == 0xFFFFFFFFFFFFFFFFU);
}

}  // namespace test_core_index

// SPDX-License-Identifier: MIT
#include <glint/core/prefetch.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <numeric>

#include <support/catch.hpp>

namespace test_core_prefetch {

TEST_CASE("prefetch: objects of any size and place stay as they are", "[core]") {
  std::array<unsigned char, 1000> bytes;
  std::iota(bytes.begin(), bytes.end(), static_cast<unsigned char>(0));
  const auto before = bytes;
  glint::prefetch(bytes);
  for (const unsigned char& byte : bytes) glint::prefetch(byte);
  CHECK(bytes == before);
}

}  // namespace test_core_prefetch

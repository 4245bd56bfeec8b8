// SPDX-License-Identifier: MIT
#include <glint/color/rgb_sum.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_color_rgb_sum {

using glint::Rgb;
using glint::RgbSum;

TEST_CASE("rgb sum: nothing is black", "[color][rgb_sum]") {
  CHECK(RgbSum{}.value() == Rgb{0});
}

TEST_CASE("rgb sum: what is small is not lost beside what is large", "[color][rgb_sum]") {
  RgbSum sum;
  sum.add({16'777'216.0F, 1, 2});  // 2²⁴: in float, adding one changes nothing
  for (int i = 0; i < 4; ++i) sum.add({1, 2, 3});
  CHECK(sum.value() == Rgb{16'777'220.0F, 9, 14});
}

}  // namespace test_color_rgb_sum

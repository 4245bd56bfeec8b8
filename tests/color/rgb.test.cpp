// SPDX-License-Identifier: MIT
#include <glint/color/rgb.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_color_rgb {

using glint::Rgb;

TEST_CASE("rgb: arithmetic is channel by channel", "[color][rgb]") {
  const Rgb a{1, 2, 4};
  const Rgb b{2, 4, 8};
  CHECK(a + b == Rgb{3, 6, 12});
  CHECK(b - a == a);
  CHECK(a * b == Rgb{2, 8, 32});
  CHECK(b / a == Rgb{2});
  CHECK(0.5F * b == a);
}

TEST_CASE("rgb: white has luminance one", "[color][rgb]") {
  CHECK(luminance(Rgb{1}) == Approx(1.0F).epsilon(1e-6));  // the Rec. 709 weights add up to one
  CHECK(luminance(Rgb{0, 1, 0}) > luminance(Rgb{1, 0, 0}));
}

TEST_CASE("rgb: one bad channel makes a color not finite", "[color][rgb]") {
  CHECK(is_finite(Rgb{1, 2, 3}));
  CHECK_FALSE(is_finite(Rgb{1, std::numeric_limits<float>::infinity(), 3}));
  CHECK_FALSE(is_finite(Rgb{std::numeric_limits<float>::quiet_NaN(), 0, 0}));
}

}  // namespace test_color_rgb

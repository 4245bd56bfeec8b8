// SPDX-License-Identifier: MIT
#include <glint/color/srgb.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>

namespace test_color_srgb {

TEMPLATE_TEST_CASE("srgb: the ends and the knee of the curve are where the standard puts them", "[color][srgb]", float,
                   double) {
  CHECK(glint::encode_srgb(TestType(0)) == 0);
  CHECK(glint::encode_srgb(TestType(1)) == Approx(1).epsilon(1e-6));
  CHECK(glint::decode_srgb(TestType(1)) == Approx(1).epsilon(1e-6));
  CHECK(glint::encode_srgb(TestType(0.002)) == Approx(0.02584).epsilon(1e-6));  // 12.92 · 0.002
  CHECK(glint::decode_srgb(TestType(0.01292)) == Approx(0.001).epsilon(1e-6));
  // (0.5 + 0.055) / 1.055 = 0.526066…; to the power 2.4: 0.214041
  CHECK(glint::decode_srgb(TestType(0.5)) == Approx(0.2140411).epsilon(1e-6));
}

TEMPLATE_TEST_CASE("srgb: decoding undoes encoding", "[color][srgb]", float, double) {
  for (int i = -10; i <= 1500; ++i) {
    const TestType linear = static_cast<TestType>(i) / 1000;
    CHECK(glint::decode_srgb(glint::encode_srgb(linear)) == Approx(linear).epsilon(1e-5));
  }
}

TEST_CASE("srgb: eight bits survive a round trip", "[color][srgb]") {
  for (int i = 0; i < 256; ++i) {
    const auto byte = static_cast<std::uint8_t>(i);
    CHECK(glint::encode_srgb8(glint::decode_srgb8(byte)) == byte);
    CHECK(static_cast<double>(glint::decode_srgb8(byte)) == Approx(glint::decode_srgb(i / 255.0)).epsilon(1e-7));
  }
}

TEST_CASE("srgb: eight bits are the nearest to the exact curve", "[color][srgb]") {
  for (int i = 0; i <= 100000; ++i) {
    const float linear = static_cast<float>(i) / 100000;
    const double exact = 255 * glint::encode_srgb(static_cast<double>(linear));
    if (std::abs(exact - std::floor(exact) - 0.5) < 1e-9) continue;  // a tie to within the oracle's rounding
    if (glint::encode_srgb8(linear) != std::lround(exact)) {
      CAPTURE(linear, exact);
      CHECK(glint::encode_srgb8(linear) == std::lround(exact));
    }
  }
  // Around every step, float by float: just below it rounds down, and from it on up.
  for (int i = 0; i < 255; ++i) {
    const auto step = static_cast<float>(glint::decode_srgb((i + 0.5) / 255));
    CHECK(glint::encode_srgb8(std::nextafter(step, 0.0F)) == i);
    CHECK(glint::encode_srgb8(std::nextafter(step, 2.0F)) == i + 1);
  }
}

TEST_CASE("srgb: what has no place in eight bits is clipped", "[color][srgb]") {
  const float infinity = std::numeric_limits<float>::infinity();
  CHECK(glint::encode_srgb8(-1) == 0);
  CHECK(glint::encode_srgb8(-infinity) == 0);
  CHECK(glint::encode_srgb8(std::numeric_limits<float>::quiet_NaN()) == 0);
  CHECK(glint::encode_srgb8(1) == 255);
  CHECK(glint::encode_srgb8(17) == 255);
  CHECK(glint::encode_srgb8(infinity) == 255);
}

}  // namespace test_color_srgb

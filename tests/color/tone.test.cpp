// SPDX-License-Identifier: MIT
#include <glint/color/tone.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <vector>

#include <support/catch.hpp>

namespace test_color_tone {

using Bytes = std::vector<std::uint8_t>;

TEST_CASE("tone: pixels become bytes row by row from the top, red first", "[color][tone]") {
  glint::Image image({2, 2});
  image(0, 0) = {1, 0, 0};
  image(1, 0) = {0, 1, 0};
  image(0, 1) = {0, 0, 1};
  image(1, 1) = {2, -1, std::numeric_limits<float>::quiet_NaN()};
  CHECK(glint::to_srgb8(image) == Bytes{255, 0, 0, 0, 255, 0, 0, 0, 255, 255, 0, 0});
  CHECK(glint::to_srgb8(glint::Image{}).empty());
}

TEST_CASE("tone: the curve works on what is exposed", "[color][tone]") {
  const glint::Image half({1, 1}, 0.5F);
  const std::uint8_t expected = glint::encode_srgb8(glint::hable_curve(1));
  CHECK(glint::to_srgb8(half, {.exposure = 1, .curve = glint::ToneCurve::Hable}) == Bytes(3, expected));
}

TEST_CASE("tone: a stop of exposure doubles the light", "[color][tone]") {
  const glint::Image quarter({1, 1}, 0.25F);
  const glint::Image half({1, 1}, 0.5F);
  CHECK(glint::to_srgb8(quarter, {.exposure = 1}) == glint::to_srgb8(half));
  CHECK(glint::to_srgb8(quarter, {.exposure = 2}) == Bytes{255, 255, 255});
  CHECK(glint::to_srgb8(half, {.exposure = -1}) == glint::to_srgb8(quarter));
}

}  // namespace test_color_tone

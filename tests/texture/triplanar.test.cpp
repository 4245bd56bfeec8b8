// SPDX-License-Identifier: MIT
#include <glint/texture/triplanar.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

namespace test_texture_triplanar {

namespace {

using glint::Rgb;
using glint::Triplanar;

/// Shows the coordinates it is asked for.
struct Coordinates {
  static Rgb evaluate(const glint::Vec2<float>& uv) { return {uv.x, uv.y, 1}; }
};

glint::Surface surface(const glint::Vec3<float>& normal) {
  return {.position = {0.25F, 0.5F, 0.75F}, .normal = normal};
}

}  // namespace

TEST_CASE("triplanar: along an axis, the texture lies at the other two coordinates", "[texture][triplanar]") {
  const Triplanar<Coordinates> texture{.scale = 2};
  const float side = GENERATE(-1.0F, 1.0F);
  CHECK(texture.evaluate(surface({side, 0, 0})) == Rgb{1.5F, 1, 1});     // (z, y)
  CHECK(texture.evaluate(surface({0, side, 0})) == Rgb{0.5F, 1.5F, 1});  // (x, z)
  CHECK(texture.evaluate(surface({0, 0, side})) == Rgb{0.5F, 1, 1});     // (x, y)
}

TEST_CASE("triplanar: sides count by the fourth power of the normal", "[texture][triplanar]") {
  // n = (2, 1, 0) / √5: weights 16 : 1 : 0. Of (z, y) = (0.75, 0.5) and (x, z) = (0.25, 0.75).
  const Triplanar<Coordinates> texture{};
  const Rgb color = texture.evaluate(surface(glint::Vec3<float>{2, 1, 0} / std::sqrt(5.0F)));
  CHECK(color.r == Approx((16 * 0.75 + 0.25) / 17));
  CHECK(color.g == Approx((16 * 0.5 + 0.75) / 17));
  CHECK(color.b == Approx(1));  // the weights are shares
  // n = (1, 1, 1) / √3: the mean of the three.
  const Rgb even = texture.evaluate(surface(glint::Vec3<float>{1, 1, -1} / std::sqrt(3.0F)));
  CHECK(even.r == Approx((0.75 + 0.25 + 0.25) / 3));
  CHECK(even.g == Approx((0.5 + 0.75 + 0.5) / 3));
}

TEST_CASE("triplanar: looks at the shading normal, and without one is black", "[texture][triplanar]") {
  glint::Surface bent = surface({0, 0, 1});
  bent.shading_normal = {1, 0, 0};
  CHECK(Triplanar{Coordinates{}}.evaluate(bent) == Rgb{0.75F, 0.5F, 1});
  CHECK(Triplanar{Coordinates{}}.evaluate(surface({0, 0, 0})) == Rgb{0});
  CHECK(Triplanar{Coordinates{}}.evaluate(glint::Vec2<float>{3, 4}) == Rgb{3, 4, 1});
}

}  // namespace test_texture_triplanar

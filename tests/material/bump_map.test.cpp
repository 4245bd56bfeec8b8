// SPDX-License-Identifier: MIT
#include <glint/material/bump_map.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>

namespace test_material_bump_map {

using glint::BumpMapped;
using glint::Lambertian;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;

namespace {

/// Heights that rise steadily: 3 u + 2 v.
struct Ramp {
  [[nodiscard]] static Rgb evaluate(const Vec2<float>& uv) noexcept { return {3 * uv.x + 2 * uv.y}; }
};

}  // namespace

TEST_CASE("bump_map: the normal leans against the slope of the heights", "[material][bump_map]") {
  const BumpMapped material{Lambertian{0.5F}, Ramp{}, 0.5F};
  STATIC_REQUIRE(glint::Material<decltype(material)>);
  // A unit of u is 2 units long: slopes of 0.5 · 3 / 2 and 0.5 · 2 / 2, so the normal is along (−3, −2, 4), length √29.
  const Vec3<float> normal = material.bsdf({.tangent = {0.0F, 2.0F, 0.0F}, .uv = {0.5F, 0.25F}}).normal();
  CHECK(normal.x == Approx(-3 / std::sqrt(29.0)).epsilon(1e-3));
  CHECK(normal.y == Approx(-2 / std::sqrt(29.0)).epsilon(1e-3));
  CHECK(normal.z == Approx(4 / std::sqrt(29.0)).epsilon(1e-3));
}

TEST_CASE("bump_map: a surface without a parametrization stays flat", "[material][bump_map]") {
  CHECK(BumpMapped{Lambertian{}, Ramp{}}.bsdf({}).normal() == Vec3<float>{0.0F, 0.0F, 1.0F});
}

TEST_CASE("bump_map: without a scale it is flat, and the base shows through", "[material][bump_map]") {
  const auto bsdf = BumpMapped{Lambertian{0.25F}, Ramp{}, 0.0F}.bsdf({.tangent = {1.0F, 0.0F, 0.0F}});
  CHECK(bsdf.normal() == Vec3<float>{0.0F, 0.0F, 1.0F});
  CHECK(bsdf.base() == Lambertian{0.25F});
}

}  // namespace test_material_bump_map

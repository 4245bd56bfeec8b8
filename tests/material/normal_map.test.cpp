// SPDX-License-Identifier: MIT
#include <glint/material/normal_map.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/texture/constant.hpp>

namespace test_material_normal_map {

using glint::ConstantTexture;
using glint::Lambertian;
using glint::NormalMapped;
using glint::Vec3;

TEST_CASE("normal_map: colors from 0 to 1 are coordinates from −1 to 1", "[material][normal_map]") {
  const NormalMapped material{Lambertian{0.5F}, ConstantTexture{{0.8F, 0.5F, 0.9F}}};
  STATIC_REQUIRE(glint::Material<decltype(material)>);
  const auto bsdf = material.bsdf({.tangent = {2.0F, 0.0F, 0.0F}});
  CHECK(bsdf.normal().x == Approx(0.6));  // (0.6, 0, 0.8) has unit length already
  CHECK(bsdf.normal().y == Approx(0).margin(1e-6));
  CHECK(bsdf.normal().z == Approx(0.8));
  CHECK(bsdf.base() == Lambertian{0.5F});
}

TEST_CASE("normal_map: normals that do not point up are left alone, and so is a surface without coordinates",
          "[material][normal_map]") {
  const Vec3<float> up{0.0F, 0.0F, 1.0F};
  CHECK(NormalMapped{Lambertian{}, ConstantTexture{{0.8F, 0.5F, 0.4F}}}.bsdf({.tangent = up}).normal() == up);
  CHECK(NormalMapped{Lambertian{}, ConstantTexture{{0.8F, 0.5F, 0.9F}}}.bsdf({}).normal() == up);
}

}  // namespace test_material_normal_map

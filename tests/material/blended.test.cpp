// SPDX-License-Identifier: MIT
#include <glint/material/blended.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/core/one_of.hpp>
#include <glint/material/textured.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>

namespace test_material_blended {

using glint::Blended;
using glint::Checkerboard;
using glint::Lambertian;
using glint::Mirror;
using glint::Rgb;

TEST_CASE("blended: the share of the second material is the texture's luminance", "[material][blended]") {
  const Blended material{Lambertian{}, Mirror{}, Checkerboard{.color0 = {0.0F, 1.0F, 0.0F}, .color1 = 0.25F}};
  STATIC_REQUIRE(glint::Material<decltype(material)>);
  CHECK(material.bsdf({.uv = {0.1F, 0.1F}}).share == Approx(0.7152));  // green's part of luminance, ITU-R BT.709
  CHECK(material.bsdf({.uv = {0.6F, 0.1F}}).share == Approx(0.25));
}

TEST_CASE("blended: textures that leave [0, 1] are held to it", "[material][blended]") {
  const Blended material{Lambertian{}, Mirror{}, Checkerboard{.color0 = -1.0F, .color1 = 2.0F}};
  CHECK(material.bsdf({.uv = {0.1F, 0.1F}}).share == 0.0F);
  CHECK(material.bsdf({.uv = {0.6F, 0.1F}}).share == 1.0F);
}

TEST_CASE("blended: materials of any kind are blended, blends too", "[material][blended]") {
  const glint::Textured<Lambertian, Checkerboard> squares{{.color0 = 0.75F, .color1 = 0.0F}};
  const glint::ConstantTexture half{0.5F};
  const Blended inner{squares, glint::OneOf<Lambertian, Mirror>{Mirror{}}, half};
  const Blended outer{inner, Lambertian{0.25F}, half};
  STATIC_REQUIRE(glint::Material<decltype(outer)>);
  const glint::Vec3<float> up{0.0F, 0.0F, 1.0F};
  // (1/2 · 3/4 + 1/2 · 0) / 2 + 1/4 / 2 = 5/16, over π
  CHECK(outer.bsdf({.uv = {0.1F, 0.1F}}).evaluate(up, up).g == Approx(0.3125 / glint::pi<double>));
}

}  // namespace test_material_blended

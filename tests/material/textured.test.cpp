// SPDX-License-Identifier: MIT
#include <glint/material/textured.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/material/concepts.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>

namespace test_material_textured {

using glint::Rgb;

namespace {

struct Height {
  static Rgb evaluate(const glint::Surface& at) { return at.position.y; }
};

}  // namespace

TEST_CASE("textured: the reflectance is the texture's at the surface's coordinates", "[material][textured]") {
  const glint::Textured<glint::Lambertian, glint::Checkerboard> material{{.color0 = Rgb{1}, .color1 = Rgb{0}}};
  STATIC_REQUIRE(glint::Material<decltype(material)>);
  CHECK(material.bsdf({.uv = {0.1F, 0.1F}}).reflectance == Rgb{1});
  CHECK(material.bsdf({.uv = {0.6F, 0.1F}}).reflectance == Rgb{0});
}

TEST_CASE("textured: everything but the reflectance stays", "[material][textured]") {
  using Rough = glint::RoughConductor<glint::Beckmann>;
  const glint::Textured<Rough, glint::ConstantTexture> material{{Rgb{0.5F}}, Rough{.eta = Rgb{7}}};
  CHECK(material.bsdf({}).eta == Rgb{7});
  CHECK(material.bsdf({}).reflectance == Rgb{0.5F});
}

TEST_CASE("textured: a texture of surfaces gets the surface, alone or among others", "[material][textured]") {
  const glint::Surface at{.position = {0, 0.25F, 0}};
  CHECK(glint::Textured<glint::Lambertian, Height>{}.bsdf(at).reflectance == Rgb{0.25F});
  using Either = glint::OneOf<glint::ConstantTexture, Height>;
  CHECK(glint::Textured<glint::Lambertian, Either>{Height{}}.bsdf(at).reflectance == Rgb{0.25F});
  CHECK(glint::Textured<glint::Lambertian, Either>{glint::ConstantTexture{1}}.bsdf(at).reflectance == Rgb{1});
}

}  // namespace test_material_textured

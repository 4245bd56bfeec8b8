// SPDX-License-Identifier: MIT
#include <glint/material/textured_principled.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/material/concepts.hpp>
#include <glint/texture/checkerboard.hpp>

namespace test_material_textured_principled {

using glint::Checkerboard;
using glint::Principled;
using glint::Rgb;

static_assert(glint::BsdfSource<glint::TexturedPrincipled<Checkerboard>>);

TEST_CASE("textured_principled: color and numbers come from textures, the rest is the base's",
          "[material][textured_principled]") {
  const Checkerboard color{.color0 = {0.1F, 0.2F, 0.3F}, .color1 = Rgb{0.9F}};
  const Checkerboard rough{.color0 = Rgb{0.25F}, .color1 = Rgb{2.0F}};
  const glint::TexturedPrincipled<Checkerboard> material{
      color, {.metallic = 0.5F, .roughness = 0.7F}, {{&Principled::roughness, rough}}};
  const Principled first = material.bsdf({.uv = {0.25F, 0.25F}});
  CHECK(first.base_color == color.color0);
  CHECK(first.roughness == Approx(0.25F));
  CHECK(first.metallic == 0.5F);
  CHECK(material.bsdf({.uv = {0.75F, 0.25F}}).roughness == 1);  // held to one
}

TEST_CASE("textured_principled: without textures of numbers it is the base in a color",
          "[material][textured_principled]") {
  const glint::TexturedPrincipled<Checkerboard> material{{}, {.coat = 1, .sheen = 0.5F}};
  CHECK(material.bsdf({}) == Principled{.base_color = Checkerboard{}.color0, .coat = 1, .sheen = 0.5F});
}

}  // namespace test_material_textured_principled

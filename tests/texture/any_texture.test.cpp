// SPDX-License-Identifier: MIT
#include <glint/texture/any_texture.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/texture/checkerboard.hpp>
#include <glint/texture/mix.hpp>

namespace test_texture_any_texture {

namespace {

using glint::AnyTexture;
using glint::Rgb;

/// A surface texture whose two answers differ.
struct Height {
  static Rgb evaluate(const glint::Surface& at) { return at.position.y; }
  static Rgb evaluate(const glint::Vec2<float>& /*uv*/) { return 7; }
};

}  // namespace

TEST_CASE("any texture: answers as the texture it holds, by coordinates and by surface", "[texture][any_texture]") {
  const glint::Checkerboard board{.color0 = 1, .color1 = 0};
  const glint::Vec2<float> odd{0.75F, 0.25F};
  CHECK(AnyTexture(board).evaluate(odd) == Rgb{0});
  CHECK(AnyTexture(board).evaluate(glint::Surface{.uv = odd}) == Rgb{0});
  CHECK(AnyTexture(board).evaluate(glint::Surface{}) == Rgb{1});
  CHECK(AnyTexture(Height{}).evaluate(glint::Surface{.position = {0, 3, 0}}) == Rgb{3});
  CHECK(AnyTexture(Height{}).evaluate(odd) == Rgb{7});
}

TEST_CASE("any texture: copies share it, and textures are made of others", "[texture][any_texture]") {
  const AnyTexture height(Height{});
  const AnyTexture copy = height;
  CHECK(copy == height);
  CHECK_FALSE(AnyTexture(Height{}) == height);
  const AnyTexture half(glint::Mix{height, AnyTexture(glint::Checkerboard{.color0 = 1}), AnyTexture(height)});
  // The height 0.25 mixed with 1 by the height: 0.25 + 0.25 (1 − 0.25).
  CHECK(half.evaluate(glint::Surface{.position = {0, 0.25F, 0}}).r == Approx(0.4375));
}

}  // namespace test_texture_any_texture

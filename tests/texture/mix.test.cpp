// SPDX-License-Identifier: MIT
#include <glint/texture/mix.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>

namespace {

using glint::ConstantTexture;
using glint::Mix;
using glint::Rgb;

struct Height {
  static Rgb evaluate(const glint::Surface& at) { return at.position.y; }
};

}  // namespace

TEST_CASE("mix: the third texture's luminance is the share of the second", "[texture][mix]") {
  const auto mixed = [](Rgb share) {
    return Mix{ConstantTexture{{1, 0, 0}}, ConstantTexture{{0, 0, 2}}, ConstantTexture{share}}.evaluate({0, 0});
  };
  CHECK(mixed(0) == Rgb{1, 0, 0});
  CHECK(mixed(0.25F).r == Approx(0.75));
  CHECK(mixed(0.25F).b == Approx(0.5));
  CHECK(mixed({0, 1, 0}).b == Approx(2 * glint::luminance({0, 1, 0})));
  CHECK(mixed(-1) == Rgb{1, 0, 0});  // held to [0, 1]
  CHECK(mixed(5) == Rgb{0, 0, 2});
  CHECK(mixed(std::numeric_limits<float>::quiet_NaN()) == Rgb{1, 0, 0});
}

TEST_CASE("mix: asks for the surface where one of its parts does", "[texture][mix]") {
  using ByCoordinates = Mix<ConstantTexture, glint::Checkerboard, ConstantTexture>;
  using BySurface = Mix<ConstantTexture, ConstantTexture, Height>;
  STATIC_REQUIRE((glint::Texture<ByCoordinates> && !glint::SurfaceTexture<ByCoordinates>));
  STATIC_REQUIRE((!glint::Texture<BySurface> && glint::SurfaceTexture<BySurface>));
  const BySurface mix{{0}, {1}, {}};
  CHECK(mix.evaluate({.position = {5, 0.75F, 5}}).r == Approx(0.75));
  CHECK(Mix{Height{}, glint::Checkerboard{.color1 = 1}, ConstantTexture{0.5F}}
            .evaluate({.position = {0, 3, 0}, .uv = {0.75F, 0.25F}})
            .r == Approx(2));  // halfway from height 3 to the odd square's 1
}

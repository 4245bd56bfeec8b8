// SPDX-License-Identifier: MIT
#include <glint/texture/mix.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <memory>

#include <support/catch.hpp>

#include <glint/texture/any_texture.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/filtered_image_texture.hpp>
#include <glint/texture/noise.hpp>

namespace test_texture_mix {

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

TEST_CASE("mix: asks for the surface where one of several textures that a part can be does", "[texture][mix]") {
  using Either = glint::OneOf<ConstantTexture, Height>;
  using Part = glint::OneOf<ConstantTexture, glint::AnyTexture>;
  const Mix<Either, Either, Either> mix{Height{}, ConstantTexture{1}, ConstantTexture{0.5F}};
  CHECK(color_at(mix, glint::Surface{.position = {0, 3, 0}}) == Rgb{2});
  // As scene files make them: AnyTexture is asked by coordinates only where coordinates are all there is.
  const Mix<Part, Part, Part> read{glint::AnyTexture(glint::NoiseTexture{}), ConstantTexture{1}, ConstantTexture{0}};
  const glint::Surface at{.position = {0.3F, 5.7F, 0.2F}};
  CHECK(color_at(read, at) == glint::NoiseTexture{}.evaluate(at));
  CHECK(color_at(read, at) != glint::NoiseTexture{}.evaluate(at.uv));
}

TEST_CASE("mix: is filtered where one of its parts can be", "[texture][mix]") {
  glint::Image halves(glint::Vec2i{2, 1});
  halves(0, 0) = 2;
  const glint::FilteredImageTexture image{.pyramid = std::make_shared<const glint::MipMap>(halves)};
  const Mix mix{image, ConstantTexture{0}, ConstantTexture{0.5F}};
  STATIC_REQUIRE(glint::FilteringTexture<decltype(mix)> && glint::asks_for_footprints<decltype(mix)>);
  CHECK(mix.evaluate({0.25F, 0.5F}).g == Approx(1));                        // half of 2, at a pixel
  CHECK(mix.evaluate({0.25F, 0.5F}, {{50, 0}, {0, 50}}).g == Approx(0.5));  // half of the image's mean
  const glint::Surface far{
      .tangent = {1, 0, 0}, .bitangent = {0, 1, 0}, .uv = {0.25F, 0.5F}, .footprint = {{50, 0, 0}, {0, 50, 0}}};
  CHECK(color_at(mix, far).g == Approx(0.5));
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

}  // namespace test_texture_mix

// SPDX-License-Identifier: MIT
#include <glint/texture/image_texture.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include <support/catch.hpp>

namespace test_texture_image_texture {

namespace {

using glint::ImageTexture;
using glint::Interpolation;
using glint::Rgb;
using glint::Wrap;

/// Pixel values 0, 1, 2, … row by row.
std::shared_ptr<const glint::Image> numbered(int width, int height) {
  auto image = std::make_shared<glint::Image>(glint::Vec2i{width, height});
  float value = 0;
  for (Rgb& pixel : image->pixels()) pixel = value++;
  return image;
}

/// Which pixel stands at position i, in or out of the image, by the definition of each mode; −1 for black.
int pixel_at(int i, int size, Wrap wrap) {
  if (wrap == Wrap::Border) return i < 0 || i >= size ? -1 : i;
  if (wrap == Wrap::Clamp) return std::min(std::max(i, 0), size - 1);
  const int period = wrap == Wrap::Repeat ? size : 2 * size;
  const int rest = ((i % period) + period) % period;
  return rest < size ? rest : 2 * size - 1 - rest;
}

/// Bilinear lookup by definition, in double, over an infinite plane of pixels.
double expected(const glint::Image& image, double s, double t, Wrap wrap_s, Wrap wrap_t) {
  const double x = s * image.width() - 0.5;
  const double y = t * image.height() - 0.5;
  double sum = 0;
  for (int j = 0; j < 2; ++j) {
    for (int i = 0; i < 2; ++i) {
      const int column = static_cast<int>(std::floor(x)) + i;
      const int row = static_cast<int>(std::floor(y)) + j;
      const double weight = (1 - std::abs(x - column)) * (1 - std::abs(y - row));
      const int i_texel = pixel_at(column, image.width(), wrap_s);
      const int j_texel = pixel_at(row, image.height(), wrap_t);
      if (i_texel >= 0 && j_texel >= 0) sum += weight * static_cast<double>(image(i_texel, j_texel).r);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("image texture: pixel centers give the pixels, v = 0 the top row", "[texture][image_texture]") {
  const auto interpolation = GENERATE(Interpolation::Bilinear, Interpolation::Nearest);
  const ImageTexture texture{.image = numbered(4, 2), .interpolation = interpolation};
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 4; ++x) {
      const glint::Vec2<float> uv{(static_cast<float>(x) + 0.5F) / 4, (static_cast<float>(y) + 0.5F) / 2};
      CHECK(texture.evaluate(uv) == Rgb{static_cast<float>(4 * y + x)});
    }
  }
}

TEST_CASE("image texture: blends neighbors, across the seam too", "[texture][image_texture]") {
  const auto image = numbered(4, 1);
  const ImageTexture repeat{.image = image};
  CHECK(repeat.evaluate({0.25F, 0.5F}) == Rgb{0.5F});  // halfway between pixels 0 and 1
  CHECK(repeat.evaluate({0, 0.5F}) == Rgb{1.5F});      // halfway between pixels 3 and 0
  CHECK(repeat.evaluate({1, 0.5F}) == Rgb{1.5F});
  const ImageTexture clamp{.image = image, .wrap_s = Wrap::Clamp, .wrap_t = Wrap::Clamp};
  CHECK(clamp.evaluate({0, 0.5F}) == Rgb{0});
  CHECK(clamp.evaluate({1, 0.5F}) == Rgb{3});
  CHECK(clamp.evaluate({-5, 7}) == Rgb{0});
  const ImageTexture mirror{.image = image, .wrap_s = Wrap::Mirror};
  CHECK(mirror.evaluate({1.125F, 0.5F}) == Rgb{3});  // the mirror image begins with its last pixel
  CHECK(mirror.evaluate({-0.125F, 0.5F}) == Rgb{0});
}

TEST_CASE("image texture: agrees with lookup by definition on an infinite plane", "[texture][image_texture]") {
  const auto wrap_s = GENERATE(Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Border);
  const auto wrap_t = GENERATE(Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Border);
  const auto size = GENERATE(glint::Vec2i(1, 1), glint::Vec2i(5, 3), glint::Vec2i(16, 7), glint::Vec2i(1, 4));
  const auto image = numbered(size.x, size.y);
  const ImageTexture texture{.image = image, .wrap_s = wrap_s, .wrap_t = wrap_t};
  std::mt19937 random(11);
  std::uniform_real_distribution<float> near(-3, 3);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const glint::Vec2<float> uv{near(random), near(random)};
    const double exact = expected(*image, static_cast<double>(uv.x), static_cast<double>(uv.y), wrap_s, wrap_t);
    worst = std::max(worst, std::abs(static_cast<double>(texture.evaluate(uv).r) - exact));
  }
  // s · size is right to an ulp of 16, and neighbors differ by at most 111.
  CHECK(worst < 111 * 2 * 16 * 1.2e-7);
}

TEST_CASE("image texture: nearest is the pixel that holds the point", "[texture][image_texture]") {
  const auto wrap = GENERATE(Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Border);
  const ImageTexture texture{
      .image = numbered(8, 1), .interpolation = Interpolation::Nearest, .wrap_s = wrap, .wrap_t = wrap};
  for (int i = -40; i < 40; ++i) {  // quarters of pixels would meet borders; these are exact and do not
    const float s = (static_cast<float>(i) + 0.25F) / 8;
    CAPTURE(i);
    CHECK(texture.evaluate({s, 0.5F}) == Rgb{static_cast<float>(std::max(0, pixel_at(i, 8, wrap)))});  // 0: black
  }
}

TEST_CASE("image texture: any coordinate gives a color within the image's", "[texture][image_texture]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto wrap = GENERATE(Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Border);
  const auto interpolation = GENERATE(Interpolation::Bilinear, Interpolation::Nearest);
  const ImageTexture texture{.image = numbered(5, 5), .interpolation = interpolation, .wrap_s = wrap, .wrap_t = wrap};
  for (const float bad : {nan, infinity, -infinity, 3e38F, -1e-30F, 1e10F}) {
    CAPTURE(bad);
    for (const auto& uv : {glint::Vec2<float>(bad, 0.3F), glint::Vec2<float>(0.3F, bad), glint::Vec2<float>(bad)}) {
      const float value = texture.evaluate(uv).r;
      CHECK((value >= 0 && value <= 24));
    }
  }
}

TEST_CASE("image texture: no image is black", "[texture][image_texture]") {
  CHECK(ImageTexture{}.evaluate({0.5F, 0.5F}) == Rgb{0});
  CHECK(ImageTexture{.image = std::make_shared<glint::Image>()}.evaluate({0.5F, 0.5F}) == Rgb{0});
}

TEST_CASE("image texture: copies share the image", "[texture][image_texture]") {
  const ImageTexture texture{.image = numbered(2, 2)};
  const ImageTexture copy = texture;
  CHECK(copy == texture);
  CHECK(copy.image.get() == texture.image.get());
}

}  // namespace test_texture_image_texture

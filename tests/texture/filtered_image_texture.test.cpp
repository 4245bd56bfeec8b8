// SPDX-License-Identifier: MIT
#include <glint/texture/filtered_image_texture.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>
#include <memory>

#include <support/catch.hpp>

#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>

namespace test_texture_filtered_image_texture {

namespace {

using glint::FilteredImageTexture;
using glint::Image;
using glint::MipMap;
using glint::Rgb;
using glint::TextureFilter;
using glint::UvFootprint;
using glint::Vec2;
using glint::Vec2i;
using glint::Wrap;

Image random_image(Vec2i size) {
  Image image(size);
  glint::Random random(5);
  for (Rgb& pixel : image.pixels()) pixel = random.uniform<float>();
  return image;
}

FilteredImageTexture texture_of(const Image& image, TextureFilter filter, Wrap wrap = Wrap::Repeat) {
  return {.pyramid = std::make_shared<const MipMap>(image), .filter = filter, .wrap_s = wrap, .wrap_t = wrap};
}

double mean(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels()) sum += double(pixel.g);
  return sum / double(image.pixels().size());
}

/// Axis-parallel, in pixels of an image of that size.
UvFootprint box_of(float width, float height, Vec2i size) {
  return {{width / static_cast<float>(size.x), 0}, {0, height / static_cast<float>(size.y)}};
}

constexpr TextureFilter both[] = {TextureFilter::Ewa, TextureFilter::Trilinear};
constexpr Wrap wraps[] = {Wrap::Repeat, Wrap::Clamp, Wrap::Mirror, Wrap::Border};

}  // namespace

TEST_CASE("filtered texture: one color stays itself under any footprint", "[texture][filtered_image_texture]") {
  glint::Random random(1);
  for (const TextureFilter filter : both) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::Clamp, Wrap::Mirror}) {
      const auto texture = texture_of(Image(Vec2i{37, 18}, {0.25F, 0.5F, 2}), filter, wrap);
      for (int i = 0; i < 200; ++i) {
        const Vec2<float> uv{6 * random.uniform<float>() - 3, 6 * random.uniform<float>() - 3};
        const float size = std::exp2(20 * random.uniform<float>() - 14);
        const UvFootprint over{{size * random.uniform<float>(), size * random.uniform<float>()},
                               {-size * random.uniform<float>(), size * random.uniform<float>()}};
        const Rgb found = texture.evaluate(uv, over);
        CHECK(found.r == Approx(0.25).epsilon(1e-5));
        CHECK(found.g == Approx(0.5).epsilon(1e-5));
        CHECK(found.b == Approx(2).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("filtered texture: without a footprint it is the bilinear one", "[texture][filtered_image_texture]") {
  const Image image = random_image({7, 5});
  glint::Random random(2);
  for (const Wrap wrap : wraps) {
    const glint::ImageTexture plain{
        .image = std::make_shared<const Image>(image), .mapping = {{2, 3}, {0.1F, 0}}, .wrap_s = wrap, .wrap_t = wrap};
    auto texture = texture_of(image, TextureFilter::Ewa, wrap);
    texture.mapping = plain.mapping;
    for (int i = 0; i < 100; ++i) {
      const Vec2<float> uv{4 * random.uniform<float>() - 2, 4 * random.uniform<float>() - 2};
      CHECK(texture.evaluate(uv) == plain.evaluate(uv));
    }
  }
}

TEST_CASE("filtered texture: trilinear at a pixel of a level is the mean of all that it covers",
          "[texture][filtered_image_texture]") {
  const Image image = random_image({16, 16});
  const auto texture = texture_of(image, TextureFilter::Trilinear);
  for (const int width : {1, 2, 4, 8, 16}) {
    for (int y = 0; y < 16; y += width) {
      for (int x = 0; x < 16; x += width) {
        double sum = 0;
        for (int j = y; j < y + width; ++j) {
          for (int i = x; i < x + width; ++i) sum += double(image(i, j).g);
        }
        const auto half = 0.5F * static_cast<float>(width);
        const Vec2<float> center = Vec2<float>{static_cast<float>(x) + half, static_cast<float>(y) + half} / 16.0F;
        const auto w = static_cast<float>(width);
        CHECK(texture.evaluate(center, box_of(w, w, image.size())).g == Approx(sum / (width * width)).epsilon(1e-5));
      }
    }
  }
}

TEST_CASE("filtered texture: trilinear goes over from level to level without a jump",
          "[texture][filtered_image_texture]") {
  const Image image = random_image({64, 64});
  const auto texture = texture_of(image, TextureFilter::Trilinear);
  const auto at_width = [&](float width) {
    return texture.evaluate({0.3F, 0.6F}, box_of(width, width, image.size())).g;
  };
  for (const float width : {2.0F, 4.0F, 16.0F, 64.0F}) {
    CHECK(std::abs(at_width(width * 0.9999F) - at_width(width * 1.0001F)) < 1e-3F);
  }
  // In the middle, by the logarithm of the width, it is the mean of both.
  CHECK(at_width(4 * std::sqrt(2.0F)) == Approx(0.5F * (at_width(4) + at_width(8))).epsilon(1e-4));
}

TEST_CASE("filtered texture: huge footprints give the mean of the image", "[texture][filtered_image_texture]") {
  const Image image = random_image({40, 24});
  const float huge = std::numeric_limits<float>::infinity();
  for (const TextureFilter filter : both) {
    for (const Wrap wrap : {Wrap::Repeat, Wrap::Clamp, Wrap::Mirror}) {
      const auto texture = texture_of(image, filter, wrap);
      for (const float width : {1e3F, 1e10F, 1e30F, huge, std::numeric_limits<float>::quiet_NaN()}) {
        CAPTURE(width);
        CHECK(texture.evaluate({0.3F, 0.7F}, box_of(width, width, image.size())).g == Approx(mean(image)));
      }
    }
  }
}

TEST_CASE("filtered texture: an ellipse weighs the finest pixels by Gaussians wherever it is narrow",
          "[texture][filtered_image_texture]") {
  // No wider than a pixel, it is taken from the finest level: compared with the sum over all pixels of the plane that
  // ImageTexture shows as the nearest ones, by the weights' definition.
  const Image image = random_image({9, 14});
  glint::Random random(4);
  for (const Wrap wrap : wraps) {
    const auto texture = texture_of(image, TextureFilter::Ewa, wrap);
    const glint::ImageTexture nearest{.image = std::make_shared<const Image>(image),
                                      .interpolation = glint::Interpolation::Nearest,
                                      .wrap_s = wrap,
                                      .wrap_t = wrap};
    for (int i = 0; i < 50; ++i) {
      const Vec2<float> uv{3 * random.uniform<float>() - 1, 3 * random.uniform<float>() - 1};
      const float angle = 7 * random.uniform<float>();
      const Vec2<float> longest = Vec2<float>{std::cos(angle), std::sin(angle)} * 7.0F;  // in pixels
      const Vec2<float> shortest = Vec2<float>{-std::sin(angle), std::cos(angle)} * 0.95F;
      const double xx = 49 * std::pow(std::cos(double(angle)), 2) + 0.9025 * std::pow(std::sin(double(angle)), 2) + 1;
      const double yy = 49 * std::pow(std::sin(double(angle)), 2) + 0.9025 * std::pow(std::cos(double(angle)), 2) + 1;
      const double xy = (49 - 0.9025) * std::cos(double(angle)) * std::sin(double(angle));
      double sum = 0;
      double weights = 0;
      for (int y = -30; y < 60; ++y) {
        for (int x = -30; x < 40; ++x) {
          const double dx = x + 0.5 - double(uv.x) * 9;
          const double dy = y + 0.5 - double(uv.y) * 14;
          const double squared = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
          if (squared > 1) continue;
          const Vec2<float> center{(static_cast<float>(x) + 0.5F) / 9, (static_cast<float>(y) + 0.5F) / 14};
          const double weight = std::exp(-2 * squared) - std::exp(-2.0);
          sum += weight * double(nearest.evaluate(center).g);
          weights += weight;
        }
      }
      const Vec2<float> size{9, 14};
      CHECK(texture.evaluate(uv, {longest / size, shortest / size}).g == Approx(sum / weights).margin(1e-4));
    }
  }
}

TEST_CASE("filtered texture: an ellipse between levels is the Gaussian mean of either, mixed",
          "[texture][filtered_image_texture]") {
  // A cosine of three waves a side: of a mean by weights of variance V is left, at its top, exp(−½ k² V). Along one
  // axis V = v (width² + 4ⁱ) + (4ⁱ − 1) / 12 pixels at level i: the ellipse, widened by a pixel of the level, and the
  // pixels of the level, themselves means. v = ½ ∫r³w / ∫r w over [0, 1] of w = e^(−2r²) − e^(−2) is 0.1361.
  const int size = 256;
  Image image(Vec2i{size, size});
  const double k = 2 * glint::pi<double> * 3 / size;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) image(x, y) = static_cast<float>(0.5 + 0.5 * std::cos(k * (x + 0.5)));
  }
  const auto texture = texture_of(image, TextureFilter::Ewa);
  const auto left_at_level = [&](double width, int i) {
    const double pixel = std::exp2(2 * i);
    return std::exp(-0.5 * k * k * (0.1361 * (width * width + pixel) + (pixel - 1) / 12));
  };
  for (const double width : {1.0, 3.0, 6.0, 11.0, 16.0}) {
    const auto w = static_cast<float>(width);
    const double level = std::log2(width);
    const int finer = static_cast<int>(level);
    const double share = level - finer;
    const double left = (1 - share) * left_at_level(width, finer) + share * left_at_level(width, finer + 1);
    CAPTURE(width);
    // Few pixels of a level stand for the integral: a variance of the disk's is off by up to 0.05 squared pixels there.
    const double off = 0.25 * k * k * 0.05 * std::exp2(2 * (finer + 1));
    CHECK(texture.evaluate({0, 0.5F}, box_of(w, w, image.size())).g == Approx(0.5 + 0.5 * left).margin(off));
  }
}

TEST_CASE("filtered texture: under a border, what lies outside is black", "[texture][filtered_image_texture]") {
  const Image white(Vec2i{32, 32}, 1);
  for (const TextureFilter filter : both) {
    const auto texture = texture_of(white, filter, Wrap::Border);
    const auto over = box_of(4, 4, white.size());
    CHECK(texture.evaluate({0.5F, 0.5F}, over).g == Approx(1));
    CHECK(texture.evaluate({1, 0.5F}, over).g == Approx(0.5).epsilon(1e-4));  // half of a symmetric neighborhood
    CHECK(texture.evaluate({0, 0}, over).g == Approx(0.25).epsilon(1e-4));
    CHECK(texture.evaluate({1.6F, 0.5F}, over) == Rgb{0});
  }
}

TEST_CASE("filtered texture: long footprints stay sharp across when elliptical", "[texture][filtered_image_texture]") {
  // Stripes along x, one of 8 pixels bright: seen along them, the ellipse averages over length alone.
  Image stripes(Vec2i{64, 64});
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) stripes(x, y) = (y / 8) % 2 == 0 ? 1.0F : 0.0F;
  }
  const auto along = box_of(16, 0.5F, stripes.size());
  const Vec2<float> in_bright{0.5F, 4.0F / 64};
  CHECK(texture_of(stripes, TextureFilter::Ewa).evaluate(in_bright, along).g > 0.95F);
  CHECK(texture_of(stripes, TextureFilter::Trilinear).evaluate(in_bright, along).g < 0.7F);
  auto bounded = texture_of(stripes, TextureFilter::Ewa);
  bounded.max_anisotropy = 1;  // as wide as long: like the mean of both stripes
  CHECK(bounded.evaluate(in_bright, along).g == Approx(0.5).margin(0.15));
}

TEST_CASE("filtered texture: the mapping scales footprints, and no image is black",
          "[texture][filtered_image_texture]") {
  const Image image = random_image({32, 32});
  for (const TextureFilter filter : both) {
    const auto plain = texture_of(image, filter);
    auto mapped = plain;
    mapped.mapping = {{4, 2}, {0.25F, 0.5F}};
    const UvFootprint over{{0.02F, 0.01F}, {-0.01F, 0.03F}};
    const UvFootprint scaled{{0.08F, 0.02F}, {-0.04F, 0.06F}};
    CHECK(mapped.evaluate({0.2F, 0.1F}, over).g == Approx(plain.evaluate({1.05F, 0.7F}, scaled).g).epsilon(1e-3));
  }
  CHECK(FilteredImageTexture{}.evaluate({0, 0}, {}) == Rgb{0});
  CHECK(FilteredImageTexture{.pyramid = std::make_shared<const MipMap>()}.evaluate({0, 0}) == Rgb{0});
}

TEST_CASE("filtered texture: coordinates that are not finite are some pixel", "[texture][filtered_image_texture]") {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const TextureFilter filter : both) {
    for (const Wrap wrap : wraps) {
      const auto texture = texture_of(Image(Vec2i{5, 5}, 1), filter, wrap);
      for (const float s : {nan, infinity, -infinity, 1e30F}) {
        const float found = texture.evaluate({s, 0.5F}, box_of(3, 2, {5, 5})).g;
        CHECK((found >= 0 && found <= 1.0001F));
      }
    }
  }
}

}  // namespace test_texture_filtered_image_texture

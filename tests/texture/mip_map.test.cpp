// SPDX-License-Identifier: MIT
#include <glint/texture/mip_map.hpp>  // first, so the header proves it stands alone

#include <cstddef>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_texture_mip_map {

namespace {

using glint::Image;
using glint::MipMap;
using glint::Rgb;
using glint::Vec2i;

Image random_image(Vec2i size, std::uint64_t seed) {
  Image image(size);
  glint::Random random(seed);
  for (Rgb& pixel : image.pixels()) {
    pixel.r = random.uniform<float>();
    pixel.g = 10 * random.uniform<float>();
    pixel.b = random.uniform<float>() - 0.5F;
  }
  return image;
}

struct Sum {
  double r = 0;
  double g = 0;
  double b = 0;
};

/// The mean of the pixels in [begin, end).
Sum mean(const Image& image, Vec2i begin, Vec2i end) {
  Sum sum;
  const double count = double(end.x - begin.x) * double(end.y - begin.y);
  for (int y = begin.y; y < end.y; ++y) {
    for (int x = begin.x; x < end.x; ++x) {
      sum.r += double(image(x, y).r) / count;
      sum.g += double(image(x, y).g) / count;
      sum.b += double(image(x, y).b) / count;
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("mip map: levels halve the image, rounded up, down to one pixel", "[texture][mip_map]") {
  const MipMap pyramid(Image(Vec2i{10, 3}));
  REQUIRE(pyramid.level_count() == 5);  // 10, 5, 3, 2, 1
  CHECK(pyramid.level(0).size() == Vec2i{10, 3});
  CHECK(pyramid.level(1).size() == Vec2i{5, 2});
  CHECK(pyramid.level(2).size() == Vec2i{3, 1});
  CHECK(pyramid.level(3).size() == Vec2i{2, 1});
  CHECK(pyramid.level(4).size() == Vec2i{1, 1});
  CHECK(MipMap(Image(Vec2i{1, 1})).level_count() == 1);
}

TEST_CASE("mip map: every level of an image of any size has its mean", "[texture][mip_map]") {
  for (const Vec2i size : {Vec2i{64, 64}, Vec2i{13, 7}, Vec2i{1, 9}, Vec2i{100, 3}, Vec2i{31, 33}}) {
    const Image image = random_image(size, 3);
    const Sum expected = mean(image, {0, 0}, size);
    const MipMap pyramid(image);
    for (int i = 0; i < pyramid.level_count(); ++i) {
      CAPTURE(size.x, size.y, i);
      const Sum found = mean(pyramid.level(i), {0, 0}, pyramid.level(i).size());
      // Each level rounds twice, by 2⁻²⁴ of a value of at most 10 at green, and roundings average out.
      CHECK(found.r == Approx(expected.r).margin(1e-7 * i));
      CHECK(found.g == Approx(expected.g).margin(1e-6 * i));
      CHECK(found.b == Approx(expected.b).margin(1e-7 * i));
    }
  }
}

TEST_CASE("mip map: where sizes are powers of two, a pixel is the mean of what it covers", "[texture][mip_map]") {
  const Image image = random_image({16, 8}, 4);
  const MipMap pyramid(image);
  for (int i = 0; i < pyramid.level_count(); ++i) {
    const Image& level = pyramid.level(i);
    const Vec2i block = image.size() / level.size();
    for (int y = 0; y < level.height(); ++y) {
      for (int x = 0; x < level.width(); ++x) {
        const Vec2i begin = Vec2i{x, y} * block;
        CHECK(level(x, y).g == Approx(mean(image, begin, begin + block).g).epsilon(1e-6));
      }
    }
  }
}

TEST_CASE("mip map: an odd row is shared by what its pixels cover", "[texture][mip_map]") {
  Image image(Vec2i{3, 1});
  image(0, 0) = 6;
  image(1, 0) = 12;
  image(2, 0) = 24;
  const MipMap pyramid(image);
  // Two pixels, 1.5 of the old ones wide: (6 + 12/2) / 1.5 and (12/2 + 24) / 1.5.
  CHECK(pyramid.level(1)(0, 0) == Rgb{8});
  CHECK(pyramid.level(1)(1, 0) == Rgb{20});
  CHECK(pyramid.level(2)(0, 0) == Rgb{14});
}

TEST_CASE("mip map: copies share the finest image, and nothing has no levels", "[texture][mip_map]") {
  const auto image = std::make_shared<const Image>(Vec2i{4, 4});
  const MipMap pyramid(image);
  const MipMap copy = pyramid;
  CHECK(&copy.level(0) == image.get());
  CHECK(MipMap().level_count() == 0);
  CHECK(MipMap(std::shared_ptr<const Image>()).empty());
  CHECK(MipMap(Image()).empty());
}

}  // namespace test_texture_mip_map

// SPDX-License-Identifier: MIT
#include <glint/film/film.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include <glint/core/one_of.hpp>

#include <support/catch.hpp>

namespace test_film_film {

namespace {

using glint::BoxFilter;
using glint::Film;
using glint::GaussianFilter;
using glint::Image;
using glint::MitchellFilter;
using glint::Rgb;
using glint::TentFilter;
using glint::Vec2;
using glint::Vec2i;
using AnyFilter = glint::OneOf<BoxFilter, TentFilter, GaussianFilter, MitchellFilter>;

/// A round filter, to be evaluated pixel by pixel since it is no product.
struct ConeFilter {
  float radius = 1.75F;
  [[nodiscard]] float evaluate(const Vec2<float>& offset) const noexcept {
    return std::max(0.0F, 1 - std::sqrt(offset.x * offset.x + offset.y * offset.y) / radius);
  }
};

struct Sample {
  Vec2<float> position;
  Rgb value;
};

/// Positions on a grid of 2⁻¹⁰ pixels, so that offsets from centers are exact and borders are met.
std::vector<Sample> samples_in(const glint::PixelRect& pixels, unsigned seed, int count) {
  std::mt19937 random(seed);
  const auto coordinate = [&](int begin, int end) {
    return static_cast<float>(std::uniform_int_distribution<int>(begin * 1024, end * 1024 - 1)(random)) / 1024;
  };
  std::uniform_real_distribution<float> light(0, 10);
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    const float x = coordinate(pixels.begin.x, pixels.end.x);
    const float y = coordinate(pixels.begin.y, pixels.end.y);
    const float r = light(random);
    const float g = light(random);
    samples.push_back({{x, y}, {r, g, 1}});
  }
  return samples;
}

template <typename F>
void fill(Film<F>& film, std::size_t index, int count = 400) {
  auto block = film.block(index);
  for (const Sample& sample : samples_in(block.pixels(), static_cast<unsigned>(index), count)) {
    REQUIRE(block.add(sample.position, sample.value));
  }
}

/// By definition: every sample to every pixel in reach, in double.
template <typename F>
std::vector<std::array<double, 4>> splatted(Vec2i size, const F& filter, const std::vector<Sample>& samples) {
  const float radius = glint::filter_radius(filter);
  std::vector<std::array<double, 4>> sums(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  for (const Sample& sample : samples) {
    for (int y = 0; y < size.y; ++y) {
      for (int x = 0; x < size.x; ++x) {
        const Vec2<float> d = sample.position - (Vec2<float>(x, y) + 0.5F);
        if (d.x < -radius || d.x >= radius || d.y < -radius || d.y >= radius) continue;
        const auto w = static_cast<double>(filter.evaluate(d));
        auto& sum = sums[static_cast<std::size_t>(y * size.x + x)];
        sum[0] += w * static_cast<double>(sample.value.r);
        sum[1] += w * static_cast<double>(sample.value.g);
        sum[2] += w * static_cast<double>(sample.value.b);
        sum[3] += w;
      }
    }
  }
  return sums;
}

template <typename F>
void check_against_definition(Vec2i size, const F& filter) {
  Film<F> film(size, filter);
  std::vector<Sample> all;
  for (std::size_t i = 0; i < film.block_count(); ++i) {
    fill(film, i, 60);
    const auto samples = samples_in(film.block(i).pixels(), static_cast<unsigned>(i), 60);
    all.insert(all.end(), samples.begin(), samples.end());
  }
  const auto sums = splatted(size, filter, all);
  const Image image = film.develop();
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      const auto& sum = sums[static_cast<std::size_t>(y * size.x + x)];
      if (sum[3] == 0) {
        CHECK(image(x, y) == Rgb{0});
        continue;
      }
      if (std::abs(sum[3]) < 1e-3) continue;  // negative weights that all but cancel: the mean has lost its digits
      CAPTURE(x, y, sum[3]);
      CHECK(static_cast<double>(image(x, y).r) == Approx(sum[0] / sum[3]).epsilon(1e-6).margin(1e-6));
      CHECK(static_cast<double>(image(x, y).g) == Approx(sum[1] / sum[3]).epsilon(1e-6).margin(1e-6));
      CHECK(static_cast<double>(image(x, y).b) == Approx(1).epsilon(1e-6));
    }
  }
}

/// Runs ranges last to first: an executor as unlike Serial as one thread can be.
struct Backward {
  [[nodiscard]] static int concurrency() { return 1; }
  template <typename Body>
  static void parallel_for(std::size_t n, std::size_t grain, Body&& body) {
    for (std::size_t end = n; end > 0;) {
      const std::size_t begin = end > grain ? end - grain : 0;
      body(begin, end);
      end = begin;
    }
  }
  template <typename G, typename H>
  static void invoke(G&& g, H&& h) {
    h();
    g();
  }
};

}  // namespace

TEST_CASE("film: deduces the box filter, or the filter given", "[film]") {
  const Film plain{{512, 512}};
  STATIC_REQUIRE(std::is_same_v<decltype(plain), const Film<BoxFilter>>);
  const Film soft{{640, 360}, GaussianFilter{.radius = 2, .alpha = 1}};
  STATIC_REQUIRE(std::is_same_v<decltype(soft), const Film<GaussianFilter>>);
  CHECK(plain.size() == Vec2i(512, 512));
  CHECK(soft.size() == Vec2i(640, 360));
  CHECK(soft.filter() == GaussianFilter{.radius = 2, .alpha = 1});
}

TEST_CASE("film: blocks cover every pixel once, in rows from the top", "[film]") {
  const auto size = GENERATE(Vec2i(1, 1), Vec2i(16, 16), Vec2i(17, 33), Vec2i(100, 5), Vec2i(0, 0), Vec2i(0, 7));
  Film film{size};
  CHECK(film.block_count() == static_cast<std::size_t>(film.block_grid().x * film.block_grid().y));
  std::vector<int> covered(static_cast<std::size_t>(size.x * size.y));
  for (std::size_t i = 0; i < film.block_count(); ++i) {
    const auto pixels = film.block(i).pixels();
    CHECK(pixels.begin.x == static_cast<int>(i) % film.block_grid().x * 16);
    CHECK(pixels.begin.y == static_cast<int>(i) / film.block_grid().x * 16);
    for (int y = pixels.begin.y; y < pixels.end.y; ++y) {
      for (int x = pixels.begin.x; x < pixels.end.x; ++x) ++covered[static_cast<std::size_t>(y * size.x + x)];
    }
  }
  CHECK(std::all_of(covered.begin(), covered.end(), [](int n) { return n == 1; }));
  CHECK(film.develop() == Image(size));
}

TEST_CASE("film: a pixel is the mean of its samples under the box", "[film]") {
  Film film{{3, 2}};
  auto block = film.block(0);
  block.add({1.25F, 0.75F}, {1, 2, 3});
  block.add({1.75F, 0.0F}, {3, 2, 5});
  Image expected({3, 2});
  expected(1, 0) = {2, 2, 4};
  CHECK(film.develop() == expected);
  film.clear();
  CHECK(film.develop() == Image({3, 2}));
}

TEST_CASE("film: a sample on the border belongs to the pixel that contains it", "[film]") {
  Film film{{4, 4}};
  film.block(0).add({2, 1}, 1);
  Image expected({4, 4});
  expected(2, 1) = 1;
  CHECK(film.develop() == expected);
}

TEST_CASE("film: a wider box covers whole pixels half-open", "[film]") {
  Film film{{5, 1}, BoxFilter{1}};  // −1 ≤ 2 − center < 1: centers 1.5 and 2.5
  film.block(0).add({2, 0.5F}, 1);
  Image expected({5, 1});
  expected(1, 0) = 1;
  expected(2, 0) = 1;
  CHECK(film.develop() == expected);
}

TEST_CASE("film: equals splatting by definition for every filter and size", "[film]") {
  const auto size = GENERATE(Vec2i(1, 1), Vec2i(16, 16), Vec2i(37, 18), Vec2i(3, 50));
  CAPTURE(size.x, size.y);
  check_against_definition(size, BoxFilter{});
  check_against_definition(size, BoxFilter{0.25F});
  check_against_definition(size, BoxFilter{1.5F});
  check_against_definition(size, TentFilter{});
  check_against_definition(size, TentFilter{2.25F});
  check_against_definition(size, GaussianFilter{});
  check_against_definition(size, GaussianFilter{.radius = 0.5F, .alpha = 2});
  check_against_definition(size, MitchellFilter{});
  check_against_definition(size, MitchellFilter{.radius = 8});
  check_against_definition(size, ConeFilter{});
  check_against_definition(size, AnyFilter{GaussianFilter{.radius = 3}});
  check_against_definition(size, AnyFilter{BoxFilter{}});
}

TEMPLATE_TEST_CASE("film: the order of blocks does not change a bit", "[film]", BoxFilter, TentFilter, GaussianFilter,
                   MitchellFilter, ConeFilter) {
  const Vec2i size{70, 45};
  Film<TestType> reference(size);
  for (std::size_t i = 0; i < reference.block_count(); ++i) fill(reference, i);
  const Image expected = reference.develop();
  const auto seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  Film<TestType> film(size);
  std::vector<std::size_t> order(film.block_count());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  for (const std::size_t i : order) fill(film, i);
  CHECK(film.develop() == expected);
  CHECK(film.develop(Backward{}) == expected);
}

TEST_CASE("film: a choice of filters gives the bits of the filter chosen", "[film]") {
  const Vec2i size{33, 20};
  Film<AnyFilter> any(size, AnyFilter{MitchellFilter{}});
  Film<MitchellFilter> one(size);
  for (std::size_t i = 0; i < one.block_count(); ++i) {
    fill(any, i);
    fill(one, i);
  }
  CHECK(any.develop() == one.develop());
}

TEMPLATE_TEST_CASE("film: an image of one color is exactly that color", "[film]", BoxFilter, TentFilter, GaussianFilter,
                   ConeFilter) {
  const Rgb color{0.1F, 1.0F / 3, 12345.678F};
  Film<TestType> film(Vec2i{40, 21});
  for (std::size_t i = 0; i < film.block_count(); ++i) {
    auto block = film.block(i);
    for (const Sample& sample : samples_in(block.pixels(), 5, 20000)) block.add(sample.position, color);
  }
  CHECK(film.develop() == Image(film.size(), color));
}

TEST_CASE("film: a million samples a pixel lose nothing", "[film]") {
  // The mean of k below 10⁶ is exact in double. Float sums round to multiples of 2¹⁵ in the end, wider than most
  // samples.
  Film film{{1, 1}};
  auto block = film.block(0);
  for (int k = 0; k < 1000000; ++k) block.add({0.5F, 0.5F}, static_cast<float>(k));
  CHECK(film.develop()(0, 0) == Rgb{499999.5F});
}

TEST_CASE("film: values that are not finite are refused and leave no trace", "[film]") {
  const float bad = GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity());
  Film film{{2, 2}, TentFilter{}};
  auto block = film.block(0);
  CHECK(block.add({0.5F, 0.5F}, 1));
  CHECK_FALSE(block.add({0.5F, 0.5F}, {1, bad, 1}));
  CHECK_FALSE(block.add({0.5F, 0.5F}, {1, 1, bad}));
  CHECK(film.develop()(0, 0) == Rgb{1});
}

TEST_CASE("film: a position that rounding put on the far border counts with the last pixel", "[film]") {
  Film film{{20, 5}};
  film.block(0).add({16, 4.5F}, 1);
  film.block(1).add({20, 5}, 2);
  const Image image = film.develop();
  CHECK(image(15, 4) == Rgb{1});
  CHECK(image(16, 4) == Rgb{0});
  CHECK(image(19, 4) == Rgb{2});
}

TEST_CASE("film: no position writes outside its block", "[film]") {
  const float wild = GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -1e30F);
  Film<MitchellFilter> film(Vec2i{48, 48});
  CHECK(film.block(4).add({wild, wild}, 1));
  const Image image = film.develop();
  CHECK(image(10, 10) == Rgb{0});  // six pixels away from the middle block, whose filter reaches two
  CHECK(image(40, 40) == Rgb{0});
}

TEST_CASE("film: odd radii are brought into range", "[film]") {
  const float radius =
      GENERATE(-1.0F, 0.0F, 1e9F, std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN());
  CAPTURE(radius);
  Film film{{40, 40}, BoxFilter{radius}};
  for (std::size_t i = 0; i < film.block_count(); ++i) {
    auto block = film.block(i);
    for (const Sample& sample : samples_in(block.pixels(), 3, 100)) block.add(sample.position, 1);
  }
  const bool covers = radius > 0;
  CHECK(film.develop() == Image(Vec2i{40, 40}, covers ? 1.0F : 0.0F));
}

}  // namespace test_film_film

// SPDX-License-Identifier: MIT
#include <glint/texture/ewa.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>

namespace test_texture_ewa {

namespace {

using glint::Ellipse;
using glint::Random;
using glint::Rgb;
using glint::Vec2;

Vec2<float> random_vector(Random& random, float length) {
  const float angle = 2 * glint::pi<float> * random.uniform<float>();
  return {length * std::cos(angle), length * std::sin(angle)};
}

/// The mean by the definition alone: every pixel far and wide, its weight from the inverse matrix, in double.
template <typename Pixel>
double brute_force(const Vec2<float>& center, const Ellipse& around, const Pixel& pixel) {
  const double xx = double(around.xx) + 1;
  const double xy = double(around.xy);
  const double yy = double(around.yy) + 1;
  double sum = 0;
  double weights = 0;
  for (int y = -60; y <= 60; ++y) {
    for (int x = -60; x <= 60; ++x) {
      const double dx = x - double(center.x);
      const double dy = y - double(center.y);
      const double squared = (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / (xx * yy - xy * xy);
      if (squared > 1) continue;
      const double weight = std::exp(-2 * squared) - std::exp(-2.0);
      sum += weight * double(pixel(x, y).g);
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace

TEST_CASE("ewa: an ellipse knows its longest and shortest radius, however it was spanned", "[texture][ewa]") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const Vec2<float> longest = random_vector(random, 5);
    const Vec2<float> shortest = Vec2<float>{-longest.y, longest.x} * 0.4F;  // of length 2
    // The same unit disk turned gives other conjugate radii of the same ellipse.
    const float angle = random.uniform<float>() * 6;
    const auto ellipse = Ellipse::spanned(longest * std::cos(angle) + shortest * std::sin(angle),
                                          shortest * std::cos(angle) - longest * std::sin(angle));
    CHECK(ellipse.squared_radii().x == Approx(25).epsilon(1e-5));
    CHECK(ellipse.squared_radii().y == Approx(4).epsilon(1e-5));
    CHECK(ellipse.rounded_to(3) == ellipse);  // 5 : 2 is less
    const Ellipse rounded = ellipse.rounded_to(2);
    CHECK(rounded.squared_radii().x == Approx(25).epsilon(1e-5));
    CHECK(rounded.squared_radii().y == Approx(6.25).epsilon(1e-5));
    // The longest radius keeps its direction: it is still an eigenvector, with eigenvalue 25.
    CHECK(rounded.xx * longest.x + rounded.xy * longest.y == Approx(25 * longest.x).margin(1e-3));
    CHECK(rounded.xy * longest.x + rounded.yy * longest.y == Approx(25 * longest.y).margin(1e-3));
  }
}

TEST_CASE("ewa: a line has no width, and is rounded to a share of its length", "[texture][ewa]") {
  const auto line = Ellipse::spanned({3, 0}, {6, 0});
  CHECK(line.squared_radii() == Vec2<float>{45, 0});
  CHECK(line.rounded_to(3).yy == Approx(5));
  CHECK(Ellipse{}.rounded_to(3) == Ellipse{});
}

TEST_CASE("ewa: is the sum over all pixels by the weights' definition", "[texture][ewa]") {
  Random random(2);
  const auto noisy = [](int x, int y) {
    const auto hash = glint::mix(static_cast<std::uint64_t>(x + 1000), static_cast<std::uint64_t>(y + 1000));
    return Rgb{static_cast<float>(hash % 1024)};
  };
  for (int i = 0; i < 300; ++i) {
    const auto around = Ellipse::spanned(random_vector(random, 16 * random.uniform<float>()),
                                         random_vector(random, 2 * random.uniform<float>()));
    const Vec2<float> center{4 * random.uniform<float>(), 4 * random.uniform<float>()};
    CAPTURE(i, around.xx, around.xy, around.yy, center.x, center.y);
    // Weights are rounded, and those on the rim may be counted or not, where they are nearly nothing.
    CHECK(elliptical_mean(center, around, noisy).g == Approx(brute_force(center, around, noisy)).epsilon(1e-4));
  }
}

TEST_CASE("ewa: a smooth function comes out as its Gaussian mean over the ellipse", "[texture][ewa]") {
  // Of cos(k·p + φ) the mean by weights of r is cos(k·c + φ) times their Fourier transform at the frequency |Lᵀ k|,
  // L Lᵀ = M + 1, here integrated numerically over the unit disk.
  const auto transform = [](double frequency) {
    double sum = 0;
    double weights = 0;
    for (int i = 0; i < 400; ++i) {
      for (int j = 0; j < 400; ++j) {
        const double x = (i + 0.5) / 200 - 1;
        const double y = (j + 0.5) / 200 - 1;
        const double squared = x * x + y * y;
        if (squared > 1) continue;
        const double weight = std::exp(-2 * squared) - std::exp(-2.0);
        sum += weight * std::cos(frequency * x);
        weights += weight;
      }
    }
    return sum / weights;
  };
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Vec2<float> k = random_vector(random, 0.5F);
    const auto wave = [&](int x, int y) {
      return Rgb{std::cos(k.x * static_cast<float>(x) + k.y * static_cast<float>(y) + 0.5F)};
    };
    const auto around = Ellipse::spanned(random_vector(random, 6), random_vector(random, 2));
    const Vec2<float> center{random.uniform<float>(), random.uniform<float>()};
    const double frequency =
        std::sqrt(double((around.xx + 1) * k.x * k.x + 2 * around.xy * k.x * k.y + (around.yy + 1) * k.y * k.y));
    const double expected = std::cos(double(k.x * center.x + k.y * center.y) + 0.5) * transform(frequency);
    // Sums over whole numbers stand for the integral: shortest radii are above 1, rims fall off linearly.
    CHECK(elliptical_mean(center, around, wave).g == Approx(expected).margin(0.02));
  }
}

TEST_CASE("ewa: a point gives the pixels around it, and one value everywhere stays", "[texture][ewa]") {
  const auto index = [](int x, int y) { return Rgb{static_cast<float>(x), static_cast<float>(y), 7}; };
  CHECK(glint::elliptical_mean({3, 5}, {}, index) == Rgb{3, 5, 7});  // the neighbors lie on the rim, and count nothing
  const Rgb between = glint::elliptical_mean({3.5F, 5.5F}, {}, index);
  CHECK(between.r == Approx(3.5));
  CHECK(between.g == Approx(5.5));
  CHECK(glint::elliptical_mean({0.2F, 0.3F}, Ellipse::spanned({20, 5}, {1, 2}), [](int, int) { return Rgb{0.3F}; }).g ==
        Approx(0.3));
}

}  // namespace test_texture_ewa

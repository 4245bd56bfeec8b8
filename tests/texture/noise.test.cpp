// SPDX-License-Identifier: MIT
#include <glint/texture/noise.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_texture_noise {

namespace {

using glint::gradient_noise;
using glint::Octaves;
using glint::Rgb;
using V = glint::Vec3<float>;

/// The slope at a lattice point: near it, noise is this slope times the way there, but for third powers.
V slope_at(const V& lattice_point, std::uint64_t seed) {
  constexpr float h = 1.0F / 1024;
  const auto along = [&](const V& axis) {
    return (gradient_noise(lattice_point + h * axis, seed) - gradient_noise(lattice_point - h * axis, seed)) / (2 * h);
  };
  return {along({1, 0, 0}), along({0, 1, 0}), along({0, 0, 1})};
}

/// A lattice point's slope, which is of whole numbers.
V whole_slope_at(const V& lattice_point, std::uint64_t seed) {
  const V slope = slope_at(lattice_point, seed);
  return {std::round(slope.x), std::round(slope.y), std::round(slope.z)};
}

double fade(double t) {
  return t * t * t * (6 * t * t - 15 * t + 10);
}

/// Perlin's definition in double: eight slopes, each weighted by the product over the axes.
double expected(const V& p, std::uint64_t seed) {
  const V cell = {std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const V at = cell + V{corner & 1, (corner >> 1) & 1, corner >> 2};
    const V slope = whole_slope_at(at, seed);
    double weight = 1;
    double rise = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double d = static_cast<double>(glint::component(p, axis)) - static_cast<double>(glint::component(at, axis));
      weight *= fade(1 - std::abs(d));
      rise += d * static_cast<double>(glint::component(slope, axis));
    }
    sum += weight * rise;
  }
  return sum;
}

}  // namespace

TEST_CASE("noise: is zero at whole coordinates, with the slope of a cube's edge", "[texture][noise]") {
  int kinds[27] = {};
  for (int i = 0; i < 300; ++i) {
    const V at{i % 10 - 5, i / 10 % 10 - 5, i / 100 - 1};
    CHECK(gradient_noise(at, 3) == 0);
    const V slope = slope_at(at, 3);
    const V whole = whole_slope_at(at, 3);
    CHECK(glm::length(slope - whole) < 0.01F);  // (20 + 1) h², and rounding in a difference over 2h
    CHECK(glm::dot(whole, whole) == 2);         // two of the three are ±1
    ++kinds[static_cast<int>(whole.x + 3 * whole.y + 9 * whole.z) + 13];
  }
  // Twelve kinds of 25 each; a count deviates by √(300 · 11 / 144) = 4.8.
  for (const int count : kinds) CHECK((count == 0 || (count > 5 && count < 50)));
  CHECK(std::count(std::begin(kinds), std::end(kinds), 0) == 27 - 12);
}

TEST_CASE("noise: agrees with its definition, and is nearly even in mean", "[texture][noise]") {
  glint::Random random(5);
  double sum = 0;
  double worst = 0;
  double largest = 0;
  for (int i = 0; i < 4000; ++i) {
    const V p = 20.0F * random.uniform_vec3<float>() - 10.0F;
    const double noise = static_cast<double>(gradient_noise(p, 3));
    worst = std::max(worst, std::abs(noise - expected(p, 3)));
    largest = std::max(largest, std::abs(noise));
    sum += noise;
  }
  CHECK(worst < 1e-5);
  CHECK(largest > 0.6);
  CHECK(largest < 1.1);
  // Its deviation is about 0.3, and points in one cell depend on each other: about 2 a cell of 8000 are as good as one.
  CHECK(std::abs(sum / 4000) < 0.03);
}

TEST_CASE("noise: is smooth where cells meet", "[texture][noise]") {
  const float h = 1.0F / 256;
  for (int i = 0; i < 50; ++i) {
    const V border{i - 25, 0.3F, 0.7F};
    const auto at = [&](float x) { return static_cast<double>(gradient_noise(border + V{x, 0, 0})); };
    const double before = (at(-h) - at(-2 * h)) / static_cast<double>(h);
    const double after = (at(2 * h) - at(h)) / static_cast<double>(h);
    CHECK(std::abs(after - before) < 0.05);  // 3h times a curvature that is 0 at the border; a kink would be of size 1
  }
}

TEST_CASE("noise: seeds differ, and any coordinate gives a number", "[texture][noise]") {
  CHECK(gradient_noise({0.5F, 0.5F, 0.5F}, 1) != gradient_noise({0.5F, 0.5F, 0.5F}, 2));
  const float infinity = std::numeric_limits<float>::infinity();
  for (const float bad : {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 3e38F, -1e10F}) {
    CAPTURE(bad);
    CHECK(gradient_noise({bad, 0.25F, 0.75F}) == gradient_noise({0, 0.25F, 0.75F}));
    CHECK(gradient_noise({bad, bad, bad}) == 0);
  }
}

TEST_CASE("fbm: is the weighted mean of octaves", "[texture][noise]") {
  const V p{0.3F, -4.6F, 2.2F};
  const Octaves three{.count = 3, .gain = 0.25F, .lacunarity = 3, .seed = 8};
  const float a = gradient_noise(p, 8);
  const float b = gradient_noise(3.0F * p, 9);
  const float c = gradient_noise(9.0F * p, 10);
  CHECK(glint::fbm(p, {.count = 1, .seed = 8}) == a);
  CHECK(glint::fbm(p, three) == Approx((a + 0.25F * b + 0.0625F * c) / 1.3125F).margin(1e-6));
  CHECK(glint::turbulence(p, three) ==
        Approx((std::abs(a) + 0.25F * std::abs(b) + 0.0625F * std::abs(c)) / 1.3125F).margin(1e-6));
}

TEST_CASE("noise texture: mixes two colors by noise over the position, scaled and shifted", "[texture][noise]") {
  const glint::NoiseTexture clouds{.color0 = {0, 1, 0}, .color1 = {1, 0, 0}, .scale = {2, 3, 4}, .offset = {1, 2, 3}};
  const glint::Surface at{.position = {0.3F, 0.4F, 0.6F}};
  const float noise = glint::fbm({1.6F, 3.2F, 5.4F});
  CHECK(clouds.evaluate(at).r == Approx(0.5 + 0.5 * static_cast<double>(noise)).margin(1e-5));
  CHECK(clouds.evaluate(at).g == Approx(0.5 - 0.5 * static_cast<double>(noise)).margin(1e-5));
  CHECK(clouds.evaluate(at).b == 0);
  const glint::Surface flat{.position = {0.3F, 0.4F, 0}};
  CHECK(clouds.evaluate(glint::Vec2<float>{0.3F, 0.4F}) == clouds.evaluate(flat));
  const glint::NoiseTexture marble{.octaves = {.count = 1}, .pattern = glint::NoisePattern::Turbulence};
  CHECK(marble.evaluate(at) == Rgb{std::abs(gradient_noise(at.position))});
  CHECK(marble.evaluate(glint::Surface{}) == Rgb{0});
}

}  // namespace test_texture_noise

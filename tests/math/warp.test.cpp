// SPDX-License-Identifier: MIT
#include <glint/math/warp.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <glint/math/random.hpp>
#include <support/catch.hpp>

namespace test_math_warp {

using glint::Vec2;
using glint::Vec3;

namespace {

template <typename T>
constexpr T epsilon = std::numeric_limits<T>::epsilon();

/// Counts how often `cell(sample)` names each of 16 cells of equal measure, and the largest departure from the mean in
/// standard deviations.
template <typename T, typename Cell>
double worst_departure(const Cell& cell) {
  constexpr int side = 256;  // a regular grid of points: its error is far below that of random ones
  constexpr double expected = side * side / 16.0;
  std::array<double, 16> counts{};
  for (int i = 0; i < side * side; ++i) {
    const Vec2<T> uv{(T(i % side) + T(0.5)) / T(side), (T(i / side) + T(0.5)) / T(side)};
    counts.at(static_cast<std::size_t>(cell(uv))) += 1;
  }
  double worst = 0;
  for (const double count : counts) worst = std::max(worst, std::abs(count - expected) / std::sqrt(expected));
  return worst;
}

/// One of four quarter turns around z, times one of four bands of `fraction` in [0, 1).
template <typename T>
int turn_and_band(T x, T y, T fraction) {
  const int turn = (x < 0 ? 1 : 0) + (y < 0 ? 2 : 0);
  return 4 * std::min(3, static_cast<int>(fraction * 4)) + turn;
}

}  // namespace

TEMPLATE_TEST_CASE("warp: the short sine and cosine agree with the library's to two units in the last place",
                   "[math][warp]", float, double) {
  for (int i = -1000; i <= 1000; ++i) {
    const TestType angle = glint::pi<TestType> / 4 * TestType(i) / 1000;
    const auto [sin, cos] = glint::sin_cos_within_eighth_turn(angle);
    const auto reference = static_cast<long double>(angle);
    REQUIRE(std::abs(double(sin - std::sin(reference))) <= double(2 * epsilon<TestType> * std::abs(sin)));
    REQUIRE(std::abs(double(cos - std::cos(reference))) <= double(2 * epsilon<TestType> / 2));  // 0.7 ≤ cos ≤ 1
  }
}

TEMPLATE_TEST_CASE("warp: rings of the square become rings of the disk", "[math][warp]", float, double) {
  using V = Vec2<TestType>;
  CHECK(glint::concentric_disk(V{0.5, 0.5}) == V{0, 0});
  CHECK(glint::concentric_disk(V{1, 0.5}) == V{1, 0});
  CHECK(glint::concentric_disk(V{0, 0.5}) == V{-1, 0});
  CHECK(glint::concentric_disk(V{0.5, 0.75}) == V{0, 0.5});
  const V corner = glint::concentric_disk(V{1, 1});  // the corner of the outer ring is at 45°
  CHECK(corner.x == Approx(std::sqrt(0.5)));
  CHECK(corner.y == Approx(std::sqrt(0.5)));
}

TEMPLATE_TEST_CASE("warp: the disk and its inverse undo each other", "[math][warp]", float, double) {
  glint::Random random{1};
  for (int i = 0; i < 1000; ++i) {
    const auto uv = random.uniform_vec2<TestType>();
    const auto back = glint::concentric_disk_inverse(glint::concentric_disk(uv));
    CAPTURE(uv.x, uv.y);
    REQUIRE(std::abs(back.x - uv.x) <= 4 * epsilon<TestType>);
    REQUIRE(std::abs(back.y - uv.y) <= 4 * epsilon<TestType>);
  }
  CHECK(glint::concentric_disk_inverse(Vec2<TestType>{0, 0}) == Vec2<TestType>{0.5, 0.5});
}

TEMPLATE_TEST_CASE("warp: the triangle and its inverse undo each other", "[math][warp]", float, double) {
  glint::Random random{2};
  for (int i = 0; i < 1000; ++i) {
    const auto uv = random.uniform_vec2<TestType>();
    const auto weights = glint::uniform_triangle(uv);
    REQUIRE(weights.x >= 0);
    REQUIRE(weights.y >= 0);
    REQUIRE(weights.x + weights.y <= 1);
    const auto back = glint::uniform_triangle_inverse(weights);
    REQUIRE(std::abs(back.x - uv.x) <= 2 * epsilon<TestType>);
    REQUIRE(std::abs(back.y - uv.y) <= 2 * epsilon<TestType>);
  }
}

TEMPLATE_TEST_CASE("warp: equal areas of the square become equal measures", "[math][warp]", float, double) {
  using T = TestType;
  // Each shape is cut in 16 cells of equal measure, by closed forms of the measure; bound in standard deviations of
  // random points, which the grid must beat.
  CHECK(worst_departure<T>([](const Vec2<T>& uv) {
          const auto p = glint::concentric_disk(uv);
          return turn_and_band(p.x, p.y, p.x * p.x + p.y * p.y);
        }) < 2);
  CHECK(worst_departure<T>([](const Vec2<T>& uv) {
          const auto w = glint::cosine_hemisphere(uv);
          return turn_and_band(w.x, w.y, 1 - w.z * w.z);  // ∫ cos θ dω grows with sin² θ
        }) < 2);
  CHECK(worst_departure<T>([](const Vec2<T>& uv) {
          const auto w = glint::uniform_hemisphere(uv);
          return turn_and_band(w.x, w.y, 1 - w.z);  // Archimedes: area grows with height
        }) < 2);
  CHECK(worst_departure<T>([](const Vec2<T>& uv) {
          const auto w = glint::uniform_sphere(uv);
          return turn_and_band(w.x, w.y, (1 - w.z) / 2);
        }) < 2);
  CHECK(worst_departure<T>([](const Vec2<T>& uv) {
          const auto w = glint::uniform_cone(uv, T(0.25));
          return turn_and_band(w.x, w.y, (1 - w.z) / T(0.25));
        }) < 2);
}

TEMPLATE_TEST_CASE("warp: triangles are covered evenly", "[math][warp]", float, double) {
  // Lines parallel to the edge opposite vertex 0, where the other weights sum to √(k/4), cut the triangle in four
  // strips of equal area; along each line the share of vertex 1 is uniform.
  CHECK(worst_departure<TestType>([](const Vec2<TestType>& uv) {
          const auto w = glint::uniform_triangle(uv);
          const auto sum = w.x + w.y;
          const int strip = std::min(3, static_cast<int>(sum * sum * 4));
          return 4 * strip + std::min(3, static_cast<int>(w.x / sum * 4));
        }) < 2);
}

TEMPLATE_TEST_CASE("warp: directions are unit vectors, at the edges of the square too", "[math][warp]", float, double) {
  using T = TestType;
  glint::Random random{3};
  for (int i = 0; i < 4000; ++i) {
    auto uv = random.uniform_vec2<T>();
    if (i % 4 == 1) uv.x = 0;
    if (i % 4 == 2) uv.y = glint::one_minus_epsilon<T>;
    if (i % 4 == 3) uv.x = T(0.5);
    for (const Vec3<T>& w : {glint::cosine_hemisphere(uv), glint::uniform_hemisphere(uv), glint::uniform_sphere(uv),
                             glint::uniform_cone(uv, T(1e-3))}) {
      REQUIRE(std::abs(glint::length_squared(w) - 1) <= 8 * epsilon<T>);
    }
    REQUIRE(glint::cosine_hemisphere(uv).z >= 0);
    REQUIRE(glint::uniform_hemisphere(uv).z >= 0);
  }
}

TEMPLATE_TEST_CASE("warp: a narrow cone keeps its width", "[math][warp]", float, double) {
  using T = TestType;
  const T sine = T(1e-6);  // in float, 1 − cos θ computed as a difference would be 0
  const T extent = glint::one_minus_cos(sine * sine);
  CHECK(extent == Approx(double(sine * sine) / 2));  // 1 − cos θ = θ²/2 − …
  const auto w = glint::uniform_cone(Vec2<T>{0, T(0.5)}, extent);
  CHECK(w.x == Approx(-1e-6));  // the rim
  CHECK(w.y == 0);
}

TEMPLATE_TEST_CASE("warp: densities are one over the measure", "[math][warp]", float, double) {
  using T = TestType;
  constexpr double pi = glint::pi<double>;
  CHECK(glint::concentric_disk_pdf<T>() == Approx(1 / pi));
  CHECK(glint::uniform_hemisphere_pdf<T>() == Approx(1 / (2 * pi)));
  CHECK(glint::uniform_sphere_pdf<T>() == Approx(1 / (4 * pi)));
  CHECK(glint::uniform_cone_pdf(T(1)) == Approx(1 / (2 * pi)));
  CHECK(glint::uniform_cone_pdf(T(2)) == Approx(1 / (4 * pi)));
  CHECK(glint::uniform_triangle_pdf(T(0.5)) == 2);
  CHECK(glint::cosine_hemisphere_pdf(T(1)) == Approx(1 / pi));
  CHECK(glint::cosine_hemisphere_pdf(T(-0.5)) == 0);
}

}  // namespace test_math_warp

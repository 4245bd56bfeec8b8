// SPDX-License-Identifier: MIT
#include <glint/light/seen_triangle.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <optional>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_light_seen_triangle {

using glint::Triangle;
using glint::Vec2;
using glint::Vec3;

static_assert(glint::SeenSampleable<Triangle<float>>);

namespace {

const Triangle<float> corner{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}};  // faces +z
const Triangle<float> turned{{1, 2, 3}, {3, 3.5F, 2}, {0.5F, 4, 4}};

/// A point before a triangle, in multiples of its edges and its unit normal.
Vec3<float> before(const Triangle<float>& t, const Vec3<float>& p) {
  const Vec3<float> e1 = t.v1 - t.v0;
  const Vec3<float> e2 = t.v2 - t.v0;
  return t.v0 + e1 * p.x + e2 * p.y + glm::normalize(glm::cross(e1, e2)) * p.z;
}

/// The triangle as a square: the distance from v0 in shares of the way, and the share of v2 at that distance.
glint::testing::ChiSquareResult samples_follow_density(const Triangle<float>& t, const Vec3<float>& from) {
  return glint::testing::chi_square_square(
      [&](const Vec2<float>& u) -> std::optional<Vec2<float>> {
        const auto sample = sample_seen(t, from, u);
        if (!sample) return std::nullopt;
        const Vec2<float> uv = sample->surface.uv;  // (w1 + w2, w2)
        return Vec2<float>{uv.x, uv.x > 0 ? uv.y / uv.x : 0};
      },
      [&](const Vec2<float>& p) {  // dω = dA cos / d², dA = 2 A p.x dp
        const float w2 = p.x * p.y;
        const glint::Surface at = surface_at(t, p.x - w2, w2);
        const Vec3<float> back = from - at.position;
        const float squared = glint::length_squared(back);
        return seen_pdf(t, from, at) * glm::dot(back, at.normal) / (squared * std::sqrt(squared)) * 2 * area(t) * p.x;
      },
      {.samples = 50'000, .resolution = {16, 16}, .significance = 1e-3, .tests = 10});
}

}  // namespace

TEST_CASE("seen triangle: points follow their density from near, from the side, and from far",
          "[light][seen_triangle]") {
  const Triangle<float> triangle = std::array{corner, turned}[static_cast<std::size_t>(GENERATE(range(0, 2)))];
  const Vec3<float> place =
      std::array{Vec3<float>{0.3F, 0.3F, 0.2F}, Vec3<float>{0.1F, 0.8F, 0.05F}, Vec3<float>{1.3F, 0.4F, 0.4F},
                 Vec3<float>{-0.5F, 1.2F, 1}, Vec3<float>{3, 4, 20}}[static_cast<std::size_t>(GENERATE(range(0, 5)))];
  CAPTURE(triangle.v1, place);
  const auto result = samples_follow_density(triangle, before(triangle, place));
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("seen triangle: one side of an octahedron fills an eighth of the sphere", "[light][seen_triangle]") {
  const Triangle<float> octant{{1, 0, 0}, {0, 0, 1}, {0, 1, 0}};  // faces the center
  const auto sample = sample_seen(octant, {0, 0, 0}, {0.3F, 0.6F});
  REQUIRE(sample);
  CHECK(1 / sample->pdf == Approx(glint::pi<float> / 2).epsilon(1e-5));
}

TEST_CASE("seen triangle: close by, the density is even where that by area is not", "[light][seen_triangle]") {
  const Vec3<float> from{0.9F, 0.9F, 0.02F};
  glint::Random random{1};
  const float first = sample_seen(corner, from, random.uniform_vec2())->pdf;
  for (int i = 0; i < 100; ++i) CHECK(sample_seen(corner, from, random.uniform_vec2())->pdf == first);
}

TEST_CASE("seen triangle: its back is not seen, nor anything from its plane", "[light][seen_triangle]") {
  CHECK_FALSE(sample_seen(corner, {0.5F, 0.5F, -0.5F}, {0.3F, 0.6F}));
  CHECK_FALSE(sample_seen(corner, {2, 1, 0}, {0.3F, 0.6F}));
  CHECK_FALSE(sample_seen(Triangle<float>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 0, 1}, {0.3F, 0.6F}));
}

}  // namespace test_light_seen_triangle

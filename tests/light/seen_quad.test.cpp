// SPDX-License-Identifier: MIT
#include <glint/light/seen_quad.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <optional>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_light_seen_quad {

using glint::Quad;
using glint::Vec2;
using glint::Vec3;

static_assert(glint::SeenSampleable<Quad<float>>);

namespace {

const Quad<float> square{.origin = {-1, -1, 0}, .edge_u = {2, 0, 0}, .edge_v = {0, 2, 0}};  // faces +z
const Quad<float> turned{.origin = {1, 2, 3}, .edge_u = {2, 2, 1}, .edge_v = {0.5F, -1, 1}};
const Quad<float> skewed{.origin = {1, 2, 3}, .edge_u = {2, 2, 1}, .edge_v = {0.5F, 1, 1}};

/// A point before a quad, in multiples of its edges and its unit normal.
Vec3<float> before(const Quad<float>& quad, const Vec3<float>& p) {
  return quad.origin + quad.edge_u * p.x + quad.edge_v * p.y +
         glm::normalize(glm::cross(quad.edge_u, quad.edge_v)) * p.z;
}

glint::testing::ChiSquareResult samples_follow_density(const Quad<float>& quad, const Vec3<float>& from) {
  return glint::testing::chi_square_square(
      [&](const Vec2<float>& u) -> std::optional<Vec2<float>> {
        const auto sample = sample_seen(quad, from, u);
        if (!sample) return std::nullopt;
        return sample->surface.uv;
      },
      [&](const Vec2<float>& uv) {  // dω = dA cos / d²
        const glint::Surface at = glint::detail::quad_surface(quad, uv);
        const Vec3<float> back = from - at.position;
        const float squared = glint::length_squared(back);
        return seen_pdf(quad, from, at) * glm::dot(back, at.normal) / (squared * std::sqrt(squared)) * area(quad);
      },
      {.samples = 50'000, .resolution = {16, 16}, .significance = 1e-3, .tests = 15});
}

}  // namespace

TEST_CASE("seen quad: points follow their density from near, from the side, and from far", "[light][seen_quad]") {
  const Quad<float> quad = std::array{square, turned, skewed}[static_cast<std::size_t>(GENERATE(range(0, 3)))];
  const Vec3<float> place =
      std::array{Vec3<float>{0.5F, 0.5F, 0.2F}, Vec3<float>{0.1F, 0.9F, 0.05F}, Vec3<float>{1.3F, 0.4F, 0.4F},
                 Vec3<float>{-0.5F, 1.7F, 2}, Vec3<float>{3, 4, 20}}[static_cast<std::size_t>(GENERATE(range(0, 5)))];
  CAPTURE(quad.edge_v, place);
  const auto result = samples_follow_density(quad, before(quad, place));
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("seen quad: the face of a cube seen from its center fills a sixth of the sphere", "[light][seen_quad]") {
  const auto sample = sample_seen(square, {0, 0, 1}, {0.3F, 0.6F});
  REQUIRE(sample);
  CHECK(1 / sample->pdf == Approx(4 * glint::pi<float> / 6).epsilon(1e-5));
}

TEST_CASE("seen quad: close by, the density is even where that by area is not", "[light][seen_quad]") {
  const Vec3<float> from{0.9F, 0.9F, 0.01F};
  glint::Random random{1};
  const float first = sample_seen(square, from, random.uniform_vec2())->pdf;
  for (int i = 0; i < 100; ++i) CHECK(sample_seen(square, from, random.uniform_vec2())->pdf == first);
}

TEST_CASE("seen quad: its back is not seen, nor anything from its plane", "[light][seen_quad]") {
  CHECK_FALSE(sample_seen(square, {0, 0, -0.5F}, {0.3F, 0.6F}));
  CHECK_FALSE(sample_seen(square, {2, 0, 0}, {0.3F, 0.6F}));
  const Quad<float> no_area{.edge_u = {1, 0, 0}, .edge_v = {2, 0, 0}};
  CHECK_FALSE(sample_seen(no_area, {0, 0, 1}, {0.3F, 0.6F}));
}

}  // namespace test_light_seen_quad

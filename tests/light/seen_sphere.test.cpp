// SPDX-License-Identifier: MIT
#include <glint/light/seen_sphere.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_light_seen_sphere {

using glint::Sphere;
using glint::Vec2;
using glint::Vec3;

static_assert(glint::SeenSampleable<Sphere<float>>);

TEST_CASE("seen sphere: its points are uniform by solid angle", "[light][seen_sphere]") {
  // Seen from +z at twice the radius, the cap up to θ = 60° is in sight: u < 1/3, a border of six cells.
  const Sphere<float> sphere{.center = {1, 2, 3}, .radius = 1.5F};
  const Vec3<float> from{1, 2, 6};
  const auto result = glint::testing::chi_square_square(
      [&](const Vec2<float>& u) { return sample_seen(sphere, from, u)->surface.uv; },
      [&](const Vec2<float>& uv) {
        // dω = dA cos / d², dA = r² sin θ dθ dφ
        const float theta = glint::pi<float> * uv.x;
        const float phi = 2 * glint::pi<float> * uv.y;
        const glint::Surface at =
            surface(sphere, sphere.center + Vec3<float>{std::sin(theta) * std::cos(phi),
                                                        std::sin(theta) * std::sin(phi), std::cos(theta)} *
                                                sphere.radius);
        const Vec3<float> back = from - at.position;
        const float squared = glint::length_squared(back);
        const float cosine = glm::dot(back, at.normal) / std::sqrt(squared);
        const float jacobian = 2 * glint::pi<float> * glint::pi<float> * 2.25F * std::sin(theta);
        return seen_pdf(sphere, from, at) * std::max(cosine, 0.0F) / squared * jacobian;
      },
      {.samples = 50'000, .resolution = {18, 16}, .significance = 1e-4});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("seen sphere: one over the density is its solid angle", "[light][seen_sphere]") {
  const Sphere<float> sphere{.radius = 3};
  // sin² = 9/25, cos = 4/5: Ω = 2π (1 − 4/5)
  const auto sample = sample_seen(sphere, {0, 5, 0}, {0.3F, 0.6F});
  REQUIRE(sample);
  CHECK(1 / sample->pdf == Approx(0.4F * glint::pi<float>).epsilon(1e-5));
}

TEST_CASE("seen sphere: points are on the sphere and in sight, near and far", "[light][seen_sphere]") {
  const auto scale = GENERATE(1e-3F, 0.999F);  // radius over distance
  CAPTURE(scale);
  const Sphere<float> sphere{.center = {-7, 3, 5}, .radius = scale * std::sqrt(83.0F)};
  glint::Random random{1};
  for (int i = 0; i < 1000; ++i) {
    const auto sample = sample_seen(sphere, {0, 0, 0}, random.uniform_vec2());
    REQUIRE(sample);
    const auto& at = sample->surface;
    CHECK(std::abs(glm::length(at.normal) - 1) < 1e-5F);
    CHECK(glm::length(at.position - (sphere.center + at.normal * sphere.radius)) < 1e-5F);
    CHECK(glm::dot(at.normal, at.position) < 1e-3F * sphere.radius);  // faces the origin, to rounding at the rim
  }
}

TEST_CASE("seen sphere: its outer side cannot be seen from inside", "[light][seen_sphere]") {
  const Sphere<float> sphere{};
  CHECK_FALSE(sample_seen(sphere, {0.5F, 0, 0}, {0.5F, 0.5F}));
  CHECK_FALSE(sample_seen(sphere, sphere.center, {0.5F, 0.5F}));
  CHECK(seen_pdf(sphere, {0.5F, 0, 0}, surface(sphere, {1, 0, 0})) == 0);
  CHECK(seen_pdf(sphere, {2, 0, 0}, surface(sphere, {-1, 0, 0})) == 0);  // the far side
  CHECK_FALSE(sample_seen(Sphere<float>{.radius = 0}, {2, 0, 0}, {0.5F, 0.5F}));
}

}  // namespace test_light_seen_sphere

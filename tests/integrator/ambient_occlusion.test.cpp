// SPDX-License-Identifier: MIT
#include <glint/integrator/ambient_occlusion.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/point.hpp>

namespace test_integrator_ambient_occlusion {

using glint::AmbientOcclusion;
using glint::Ray;

namespace {

/// A floor at y = 0 below a ball of radius 1 around (0, 2, 0): from the origin it fills a cone of sin θ = 1/2.
const std::vector<glint::Quad<float>> ground{{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}}};
const std::vector<glint::Sphere<float>> ball{{.center = {0, 2, 0}, .radius = 1}};
const glint::Scene scene{glint::Bvh{glint::Joined{glint::Elements{ground}, glint::Elements{ball}}},
                         glint::Lambertian{glint::Rgb{0.5F}}, glint::PointLight{{0, 9, 0}, glint::Rgb{1}}};
const Ray<float> from_above{.origin = {2, 0.5F, 0}, .direction = {-2, -0.5F, 0}};
const Ray<float> from_below{.origin = {2, -0.5F, 0}, .direction = {-2, 0.5F, 0}};

}  // namespace

TEST_CASE("ambient occlusion: a ball hides sin² θ of the sky", "[integrator][ambient_occlusion]") {
  const auto open = estimate(AmbientOcclusion{}, scene, from_above, 20000);
  CHECK(open.mean == Approx(0.75).margin(0.0125));  // four standard deviations: 4 √(0.75 · 0.25 / 20000)
}

TEST_CASE("ambient occlusion: what is too far hides nothing", "[integrator][ambient_occlusion]") {
  CHECK(estimate(AmbientOcclusion{.distance = 0.99F}, scene, from_above, 2000).mean == 1);
}

TEST_CASE("ambient occlusion: a surface is open on the side it is seen from", "[integrator][ambient_occlusion]") {
  CHECK(estimate(AmbientOcclusion{}, scene, from_below, 2000).mean == 1);
}

TEST_CASE("ambient occlusion: nothing is white", "[integrator][ambient_occlusion]") {
  const Ray<float> away{.origin = {0, 9, 0}, .direction = {0, 1, 0}};
  CHECK(estimate(AmbientOcclusion{}, scene, away, 1).mean == 1);
}

}  // namespace test_integrator_ambient_occlusion

// SPDX-License-Identifier: MIT
#include <glint/integrator/light_tracer.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <vector>

#include <integrator/rooms.hpp>
#include <integrator/transport_rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/camera/orthographic.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>

namespace test_integrator_light_tracer {

using glint::Lambertian;
using glint::LightTracer;
using glint::Path;
using glint::Rgb;

namespace {

const glint::Perspective view{.eye = {0, 0, 0.9F}, .target = {0, -0.2F, -1}, .fov_y_radians = 1.2F};

// Each comparison takes the largest of five z, of 32 means: with Student's t of 15 degrees and more, five standard
// errors come by chance to less than 2e-4 · 5 a comparison.
constexpr double bound = 5;

template <typename S, typename C>
double difference_to_path(const S& scene, const C& camera, int depth) {
  const auto expected = block_means(Path{.max_depth = depth}, scene, camera, 20, 16, 1);
  CHECK(expected.blocks.at(4).mean > 0.05);
  return largest_z(expected, block_means(LightTracer{.max_depth = depth}, scene, camera, 60, 16, 1001));
}

}  // namespace

TEST_CASE("light tracer: agrees with the path tracer in a room with a lamp, through any camera",
          "[integrator][light_tracer]") {
  const auto walls = lamp_room();
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}}, lamp_of(walls)};
  CHECK(difference_to_path(scene, view, 2) < bound);
  CHECK(difference_to_path(scene, view, 4) < bound);
  const glint::ThinLens lens{
      .eye = view.eye, .target = view.target, .fov_y_radians = 1.2F, .lens_radius = 0.1F, .focus_distance = 1};
  CHECK(difference_to_path(scene, lens, 3) < bound);
  CHECK(difference_to_path(scene, glint::Orthographic{.eye = view.eye, .target = view.target}, 3) < bound);
}

TEST_CASE("light tracer: agrees with the path tracer on point lights", "[integrator][light_tracer]") {
  const auto walls = room_walls();
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}},
                           glint::PointLight{{0.2F, 0.3F, 0}, Rgb{1}}};
  CHECK(difference_to_path(scene, view, 3) < bound);
}

TEST_CASE("light tracer: agrees with the path tracer on frosted glass under a sky", "[integrator][light_tracer]") {
  const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -1}, .radius = 0.8F},
                                                  {.center = {1, 0, -1}, .radius = 0.5F}};
  const glint::RoughDielectric<glint::Ggx> glass{.distribution = {.alpha_x = 0.4F, .alpha_y = 0.4F}};
  const glint::Scene scene{glint::Bvh{glint::Elements{spheres}}, glass, glint::ConstantEnvironment{Rgb{1}}};
  CHECK(difference_to_path(scene, view, 4) < bound);
}

TEST_CASE("light tracer: a point light lights a floor by the inverse square and the cosine",
          "[integrator][light_tracer]") {
  const std::vector<glint::Quad<float>> floor{{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{floor}}, Lambertian{Rgb{0.5F}},
                           glint::PointLight{{0, 4, 0}, Rgb{100}}};
  const glint::Orthographic above{.eye = {0, 2, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .height = 0.2F};
  const auto seen = block_means(LightTracer{}, scene, above, 4000, 8, 1).blocks.at(4);
  // ρ/π · I/h², but for a fall of 2e-3 toward the corners; few paths hit: the error is what they say.
  CHECK(std::abs(seen.mean - 0.5 / glint::pi<double> * 100 / 16) < 5 * seen.error + 2e-3);
  CHECK(seen.error < 0.05);
}

TEST_CASE("light tracer: a lamp lights a floor by Lambert's formula", "[integrator][light_tracer]") {
  const FloorBelowLamp below;
  const auto seen = block_means(LightTracer{.max_depth = 2}, below.scene(), below.camera, 200, 16, 1).blocks.at(4);
  CHECK(std::abs(seen.mean - floor_below_lamp(0.5, 0.5)) <= bound * seen.error + 1e-6);
  CHECK(seen.error < 0.02 * seen.mean);
}

TEST_CASE("light tracer: depth one shows the lights alone", "[integrator][light_tracer]") {
  const Furnace furnace;
  const auto seen = block_means(LightTracer{.max_depth = 1}, furnace.scene(0.5F), view, 1, 2, 1);
  CHECK(seen.blocks.at(4).mean == Approx(1).epsilon(1e-6));
  CHECK(block_means(LightTracer{.max_depth = 0}, furnace.scene(0.5F), view, 1, 2, 1).blocks.at(4).mean == 0);
}

}  // namespace test_integrator_light_tracer

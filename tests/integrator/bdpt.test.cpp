// SPDX-License-Identifier: MIT
#include <glint/integrator/bdpt.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstdint>
#include <vector>

#include <integrator/rooms.hpp>
#include <integrator/transport_rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/light_tracer.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/material_table.hpp>

namespace test_integrator_bdpt {

using glint::Bdpt;
using glint::Lambertian;
using glint::LightStrategy;
using glint::Path;
using glint::Rgb;

namespace {

const glint::Perspective view{.eye = {0, 0, 0.9F}, .target = {0, -0.2F, -1}, .fov_y_radians = 1.2F};

// Each comparison takes the largest of five z of means over 16 runs each: with Student's t of 15 degrees or more, five
// standard errors come by chance to less than 5 · 2e-4.
constexpr double bound = 5;

template <typename I, typename S, typename C>
double difference(const I& integrator, const S& scene, const C& camera, int depth, int samples = 20) {
  const auto expected = block_means(integrator, scene, camera, samples, 16, 1);
  CHECK(expected.blocks.at(4).mean > 0.02);
  return largest_z(expected, block_means(Bdpt{.max_depth = depth}, scene, camera, 20, 16, 1001));
}

}  // namespace

TEST_CASE("bdpt: agrees with all others in a room with a lamp", "[integrator][bdpt]") {
  const auto walls = lamp_room();
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}}, lamp_of(walls)};
  for (const int depth : {2, 3, 6}) {
    CAPTURE(depth);
    CHECK(difference(Path{.max_depth = depth}, scene, view, depth) < bound);
  }
  CHECK(difference(Path{.max_depth = 3, .strategy = LightStrategy::RandomWalk}, scene, view, 3, 60) < bound);
  CHECK(difference(glint::LightTracer{.max_depth = 3}, scene, view, 3, 40) < bound);
  const glint::ThinLens lens{
      .eye = view.eye, .target = view.target, .fov_y_radians = 1.2F, .lens_radius = 0.1F, .focus_distance = 1};
  CHECK(difference(Path{.max_depth = 4}, scene, lens, 4) < bound);
}

TEST_CASE("bdpt: agrees with the path tracer on rough metal, where shading is not diffuse", "[integrator][bdpt]") {
  const auto walls = lamp_room();
  const glint::RoughConductor<glint::Ggx> metal{.distribution = {.alpha_x = 0.4F, .alpha_y = 0.3F}};
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, metal, lamp_of(walls)};
  CHECK(difference(Path{.max_depth = 4}, scene, view, 4) < bound);
}

TEST_CASE("bdpt: agrees with the random walk on the light that a glass ball gathers", "[integrator][bdpt]") {
  using Bsdf = glint::OneOf<Lambertian, glint::Dielectric>;
  const auto walls = lamp_room();
  const std::vector<glint::Sphere<float>> ball{{.center = {0.2F, -0.4F, -0.3F}, .radius = 0.35F}};
  auto lights = lamp_of(walls);
  lights.of_primitive.push_back(glint::none<std::uint32_t>);
  glint::MaterialTable<Bsdf> table{{Bsdf{Lambertian{Rgb{0.5F}}}, Bsdf{glint::Dielectric{}}},
                                   std::vector<std::uint32_t>(walls.size() + 1, 0)};
  table.of_primitive.back() = 1;
  const glint::Scene scene{glint::Bvh{glint::Joined{glint::Elements{walls}, glint::Elements{ball}}}, table, lights};
  CHECK(difference(Path{.max_depth = 6, .strategy = LightStrategy::RandomWalk}, scene, view, 6, 60) < bound);
}

TEST_CASE("bdpt: agrees with the path tracer on point lights, parallel light and a sky", "[integrator][bdpt]") {
  const auto walls = room_walls();
  const glint::Scene point{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}},
                           glint::PointLight{{0.2F, 0.3F, 0}, Rgb{1}}};
  CHECK(difference(Path{.max_depth = 3}, point, view, 3) < bound);
  using Light = glint::OneOf<glint::DirectionalLight, glint::ConstantEnvironment>;
  const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -1}, .radius = 0.8F},
                                                  {.center = {1, 0, -1}, .radius = 0.5F}};
  const glint::Lights<Light> lights{
      {Light{glint::DirectionalLight{{-1, -1, -1}, Rgb{1}}}, Light{glint::ConstantEnvironment{Rgb{0.5F}}}}};
  const glint::Scene open{glint::Bvh{glint::Elements{spheres}}, Lambertian{Rgb{0.7F}}, lights};
  CHECK(difference(Path{.max_depth = 4}, open, view, 4) < bound);
}

TEST_CASE("bdpt: in a furnace the radiance is the geometric series, at every depth", "[integrator][bdpt]") {
  const int depth = GENERATE(1, 2, 5);
  CAPTURE(depth);
  const Furnace furnace;
  const auto seen =
      block_means(Bdpt{.max_depth = depth, .roulette_below = 0}, furnace.scene(0.5F), view, 20, 16, 1).blocks.at(4);
  const double expected = (1 - std::pow(0.5, depth)) / (1 - 0.5);
  CHECK(std::abs(seen.mean - expected) <= bound * seen.error + 1e-5);
}

TEST_CASE("bdpt: a lamp lights a floor by Lambert's formula", "[integrator][bdpt]") {
  const FloorBelowLamp below;
  const auto seen = block_means(Bdpt{.max_depth = 2}, below.scene(), below.camera, 20, 16, 1).blocks.at(4);
  CHECK(std::abs(seen.mean - floor_below_lamp(0.5, 0.5)) <= bound * seen.error + 1e-6);
  CHECK(seen.error < 0.02 * seen.mean);
}

TEST_CASE("bdpt: no depth, no light", "[integrator][bdpt]") {
  const Furnace furnace;
  CHECK(block_means(Bdpt{.max_depth = 0}, furnace.scene(0.5F), view, 1, 2, 1).blocks.at(4).mean == 0);
}

}  // namespace test_integrator_bdpt

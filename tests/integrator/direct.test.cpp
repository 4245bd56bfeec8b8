// SPDX-License-Identifier: MIT
#include <glint/integrator/direct.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <integrator/transport_rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/core/one_of.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/material_table.hpp>

namespace test_integrator_direct {

using glint::Direct;
using glint::Lambertian;
using glint::LightStrategy;
using glint::Ray;
using glint::Rgb;

namespace {

using Light = glint::AreaLight<glint::Quad<float>>;

constexpr LightStrategy strategies[] = {LightStrategy::Mis, LightStrategy::NextEvent, LightStrategy::RandomWalk};

/// By how many standard errors two estimates differ.
double z(const Estimate& a, const Estimate& b) {
  return std::abs(a.mean - b.mean) / std::hypot(a.error, b.error);
}

}  // namespace

TEST_CASE("direct: below a square lamp every strategy finds Lambert's formula", "[integrator][direct]") {
  const FloorBelowLamp floor;
  const auto scene = floor.scene();
  const double expected = floor_below_lamp(0.5, 0);  // right below the lamp
  for (const LightStrategy strategy : strategies) {
    CAPTURE(static_cast<int>(strategy));
    const Ray<float> ray{.origin = {0, 1, 0}, .direction = {0, -1, 0}};
    const auto [mean, error] = estimate(Direct{.strategy = strategy}, scene, ray, 40'000);
    CHECK(error > 0);
    CHECK(error < 0.01 * expected);
    CHECK(std::abs(mean - expected) <= 4 * error);
  }
}

TEST_CASE("direct: strategies agree in a room, and with paths of two segments", "[integrator][direct]") {
  const auto walls = lamp_room();
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}}, lamp_of(walls)};
  const Ray<float> ray{.direction = {0.2F, -0.6F, -1}};
  const auto mis = estimate(Direct{}, scene, ray, 20'000);
  const auto lights = estimate(Direct{.strategy = LightStrategy::NextEvent}, scene, ray, 20'000);
  const auto bsdf = estimate(Direct{.strategy = LightStrategy::RandomWalk}, scene, ray, 200'000);
  CHECK(z(mis, bsdf) <= 4);
  CHECK(z(lights, bsdf) <= 4);
  CHECK(z(lights, estimate(glint::Path{.max_depth = 2}, scene, ray, 20'000)) <= 4);
  const auto all = estimate(glint::Path{}, scene, ray, 20'000);
  CHECK(all.mean > lights.mean + 10 * all.error);  // the room is lit indirectly, too
}

TEST_CASE("direct: strategies agree where a BSDF has specular and other lobes", "[integrator][direct]") {
  // A coated floor below a lamp that it mirrors: the coat shows the lamp, the base is lit by it.
  const FloorBelowLamp floor;
  const glint::Lights<Light> lights{{{floor.quads[1], Rgb{1}}}, {glint::none<std::uint32_t>, 0}};
  const glint::Scene scene{glint::Bvh{glint::Elements{floor.quads}}, glint::CoatedDiffuse{Rgb{0.5F}}, lights};
  const Ray<float> ray{.origin = {0, 1, 0}, .direction = {0.3F, -1, 0}};
  const auto mis = estimate(Direct{}, scene, ray, 60'000);
  const auto by_light = estimate(Direct{.strategy = LightStrategy::NextEvent}, scene, ray, 60'000);
  const auto by_bsdf = estimate(Direct{.strategy = LightStrategy::RandomWalk}, scene, ray, 60'000);
  CHECK(by_bsdf.error < 0.01 * by_bsdf.mean);
  CHECK(z(mis, by_bsdf) <= 4);
  CHECK(z(by_light, by_bsdf) <= 4);
  CHECK(z(mis, by_light) <= 4);
}

TEST_CASE("direct: a mirror shows a lit floor where the depth allows", "[integrator][direct]") {
  // The ray from (0, 1, 0) meets a mirror at z = −2 and, from there, the floor y = 0 below a point lamp.
  using Material = glint::OneOf<Lambertian, glint::Mirror>;
  const std::vector<glint::Quad<float>> quads{{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}},
                                              {{-1, 0.1F, -2}, {2, 0, 0}, {0, 2, 0}}};
  const glint::MaterialTable<Material> materials{{Lambertian{Rgb{0.5F}}, glint::Mirror{Rgb{0.7F}}}, {0, 1}};
  const glint::Scene scene{glint::Bvh{glint::Elements{quads}}, materials, glint::PointLight{{0, 2, 0}, Rgb{8}}};
  // Down by 0.25 a unit: at the mirror y = 0.5, on the floor after 2 more units, at (0, 0, 0), two below the lamp.
  const Ray<float> ray{.origin = {0, 1, 0}, .direction = {0, -0.25F, -1}};
  const double expected = 0.7 * 0.5 / glint::pi<double> * 8 / 4;  // R · ρ/π · I/d²
  for (const LightStrategy strategy : {LightStrategy::Mis, LightStrategy::NextEvent}) {
    CHECK(estimate(Direct{.max_depth = 3, .strategy = strategy}, scene, ray, 4).mean == Approx(expected).epsilon(1e-5));
    CHECK(estimate(Direct{.max_depth = 2, .strategy = strategy}, scene, ray, 4).mean == 0);
  }
  CHECK(estimate(Direct{.strategy = LightStrategy::RandomWalk}, scene, ray, 4).mean == 0);  // blind to points
}

TEST_CASE("direct: a floor under a uniform sky shows its reflectance", "[integrator][direct]") {
  const std::vector<glint::Quad<float>> floor{{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{floor}}, Lambertian{Rgb{0.6F}},
                           glint::ConstantEnvironment{Rgb{2}}};
  for (const LightStrategy strategy : strategies) {
    CAPTURE(static_cast<int>(strategy));
    const auto [mean, error] = estimate(Direct{.strategy = strategy}, scene, Ray<float>{.direction = {0, -1, 0}}, 5000);
    CHECK(std::abs(mean - 1.2) <= 4 * error + 1e-5);  // 0.6 · 2
    CHECK(estimate(Direct{.strategy = strategy}, scene, Ray<float>{.direction = {0, 1, 0}}, 1).mean == 2);
  }
}

}  // namespace test_integrator_direct

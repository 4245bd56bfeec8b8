// SPDX-License-Identifier: MIT
#include <glint/integrator/path.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/two_sided.hpp>

namespace test_integrator_path {

using glint::Lambertian;
using glint::LightStrategy;
using glint::Path;
using glint::Ray;
using glint::Rgb;
using glint::Vec3;

TEST_CASE("path: in a furnace the radiance is the geometric series, at every depth and by every strategy",
          "[integrator][path]") {
  const auto strategy = GENERATE(LightStrategy::Mis, LightStrategy::NextEvent, LightStrategy::RandomWalk);
  const int depth = GENERATE(1, 2, 3, 8);
  CAPTURE(static_cast<int>(strategy), depth);
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const Path path{.max_depth = depth, .roulette_below = 0, .strategy = strategy};
  const auto [mean, error] = estimate(path, scene, Ray<float>{.direction = {0.3F, 0.5F, -0.8F}}, 20'000);
  const double expected = (1 - std::pow(0.5, depth)) / (1 - 0.5);
  CHECK(std::abs(mean - expected) <= 4 * error + 1e-6);
}

TEST_CASE("path: a furnace of a hundred lights, chosen by a tree, is as bright as one of six", "[integrator][path]") {
  const auto strategy = GENERATE(LightStrategy::Mis, LightStrategy::NextEvent);
  CAPTURE(static_cast<int>(strategy));
  std::vector<glint::Quad<float>> tiles;
  glint::Lights<Furnace::Light> lights;
  for (const glint::Quad<float>& wall : room_walls()) {
    for (int i = 0; i < 16; ++i) {
      const Vec3<float> u = wall.edge_u * 0.25F;
      const Vec3<float> v = wall.edge_v * 0.25F;
      const glint::Quad<float> tile{wall.origin + u * static_cast<float>(i % 4) + v * static_cast<float>(i / 4), u, v};
      lights.of_primitive.push_back(static_cast<std::uint32_t>(tiles.size()));
      lights.all.push_back({tile, Rgb{1}});
      tiles.push_back(tile);
    }
  }
  static_assert(6 * 16 >= glint::AdaptiveLightSampler::many);
  const glint::Scene scene{glint::Bvh{glint::Elements{tiles}}, Lambertian{Rgb{0.5F}}, lights};
  const Path path{.max_depth = 3, .roulette_below = 0, .strategy = strategy};
  const auto [mean, error] = estimate(path, scene, Ray<float>{.direction = {0.3F, 0.5F, -0.8F}}, 20'000);
  CHECK(std::abs(mean - 1.75) <= 4 * error + 1e-6);  // 1 + 1/2 + 1/4
}

TEST_CASE("path: Russian roulette changes the noise, not the mean", "[integrator][path]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.8F);
  const Path path{.max_depth = 100, .roulette_below = 0.5F};
  const auto [mean, error] = estimate(path, scene, Ray<float>{}, 20'000);
  CHECK(error > 0);
  CHECK(std::abs(mean - 5) <= 4 * error);  // 1 / (1 − 0.8), but for 0.8¹⁰⁰
}

TEST_CASE("path: a convex body under a uniform sky shows its reflectance", "[integrator][path]") {
  const auto strategy = GENERATE(LightStrategy::Mis, LightStrategy::NextEvent, LightStrategy::RandomWalk);
  CAPTURE(static_cast<int>(strategy));
  const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -4}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{spheres}}, Lambertian{Rgb{0.6F}},
                           glint::ConstantEnvironment{Rgb{2}}};
  const auto [mean, error] =
      estimate(Path{.strategy = strategy}, scene, Ray<float>{.direction = {0.1F, 0.1F, -1}}, 40'000);
  CHECK(std::abs(mean - 1.2) <= 4 * error + 1e-5);  // 0.6 · 2
}

TEST_CASE("path: strategies agree where light comes from an area and bounces", "[integrator][path]") {
  auto walls = room_walls();
  walls.push_back({{-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}});  // a lamp below the ceiling, facing down
  using Light = glint::AreaLight<glint::Quad<float>>;
  glint::Lights<Light> lights{{Light{walls.back(), Rgb{10}}}, std::vector(7, glint::none<std::uint32_t>)};
  lights.of_primitive.back() = 0;
  const glint::Scene scene{glint::Bvh{glint::Elements{walls}}, Lambertian{Rgb{0.5F}}, lights};
  const Ray<float> ray{.direction = {0.2F, -0.6F, -1}};
  const auto mis = estimate(Path{.max_depth = 4}, scene, ray, 30'000);
  const auto next_event = estimate(Path{.max_depth = 4, .strategy = LightStrategy::NextEvent}, scene, ray, 30'000);
  const auto walk = estimate(Path{.max_depth = 4, .strategy = LightStrategy::RandomWalk}, scene, ray, 300'000);
  CHECK(mis.mean > 0.1);
  CHECK(std::abs(mis.mean - walk.mean) <= 4 * (mis.error + walk.error));
  CHECK(std::abs(next_event.mean - walk.mean) <= 4 * (next_event.error + walk.error));
}

TEST_CASE("path: a point light reaches a surface by next-event estimation alone", "[integrator][path]") {
  const std::vector<glint::Quad<float>> floor{{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{floor}}, Lambertian{Rgb{0.5F}},
                           glint::PointLight{{0, 1, 0}, Rgb{8}}};
  const Ray<float> ray{.direction = {0, -1, 0}};
  const auto lit = estimate(Path{}, scene, ray, 10);
  CHECK(lit.mean == Approx(0.5 / glint::pi<double> * 8 / 4).epsilon(1e-5));  // ρ/π · I/d², no noise
  CHECK(estimate(Path{.max_depth = 1}, scene, ray, 10).mean == 0);
  CHECK(estimate(Path{.strategy = LightStrategy::RandomWalk}, scene, ray, 100).mean == 0);
}

TEST_CASE("path: clear glass under a uniform sky cannot be seen", "[integrator][path]") {
  const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -4}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{spheres}}, glint::Dielectric{},
                           glint::ConstantEnvironment{Rgb{1}}};
  const auto [mean, error] =
      estimate(Path{.max_depth = 200, .roulette_below = 0}, scene, Ray<float>{.direction = {0.12F, 0.1F, -1}}, 20'000);
  CHECK(std::abs(mean - 1) <= 4 * error + 1e-4);
}

TEST_CASE("path: a mirror shows what it reflects", "[integrator][path]") {
  const std::vector<glint::Quad<float>> mirror{{{-1, -1, -2}, {2, 0, 0}, {0, 2, 0}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{mirror}}, glint::Mirror{Rgb{0.7F}},
                           glint::ConstantEnvironment{Rgb{3}}};
  CHECK(estimate(Path{}, scene, Ray<float>{}, 4).mean == Approx(2.1).epsilon(1e-6));
  CHECK(estimate(Path{.max_depth = 1}, scene, Ray<float>{}, 4).mean == 0);
}

}  // namespace test_integrator_path

// SPDX-License-Identifier: MIT
#include <glint/integrator/path_limits.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/material_table.hpp>

namespace test_integrator_path_limits {

using glint::BounceLimits;
using glint::LightClamp;
using glint::Path;
using glint::Ray;
using glint::Rgb;

TEST_CASE("path limits: a bounce is transmissive, diffuse or glossy", "[integrator][path_limits]") {
  BounceLimits left{.diffuse = 1, .glossy = 2, .transmissive = 1};
  const glint::Vec3<float> up{0, 0, 1};
  const glint::BsdfSample through{.wi = {0, 0, -1}, .lobe = glint::Lobe::Diffuse};
  CHECK(left.take(up, {.wi = up, .lobe = glint::Lobe::Glossy}));
  CHECK(left.take(up, {.wi = up, .lobe = glint::Lobe::Specular}));
  CHECK_FALSE(left.take(up, {.wi = up, .lobe = glint::Lobe::Glossy}));
  CHECK(left.take(up, {.wi = up, .lobe = glint::Lobe::Diffuse}));
  CHECK_FALSE(left.take(up, {.wi = up, .lobe = glint::Lobe::Diffuse}));
  CHECK(left.take(up, through));
  CHECK_FALSE(left.take(-up, {.wi = up, .lobe = glint::Lobe::Specular}));
}

TEST_CASE("path limits: in a diffuse furnace they end the geometric series", "[integrator][path_limits]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const int limit = GENERATE(0, 1, 3);
  const auto strategy = GENERATE(glint::LightStrategy::Mis, glint::LightStrategy::RandomWalk);
  const Path path{.max_depth = 50, .roulette_below = 0, .strategy = strategy, .limits = {.diffuse = limit}};
  const auto [mean, error] = estimate(path, scene, Ray<float>{.direction = {0.3F, 0.5F, -0.8F}}, 20'000);
  // The walls are seen after none to limit + 1 bounces: 1 + ρ + … + ρ^(limit + 1).
  CHECK(std::abs(mean - (2 - std::pow(0.5, limit + 1))) <= 4 * error + 1e-6);
}

TEST_CASE("path limits: other kinds of bounces are not counted", "[integrator][path_limits]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const Path path{.max_depth = 3, .limits = {.glossy = 0, .transmissive = 0}};
  const auto [mean, error] = estimate(path, scene, Ray<float>{.direction = {0.3F, 0.5F, -0.8F}}, 20'000);
  CHECK(std::abs(mean - 1.75) <= 4 * error + 1e-6);  // 1 + 1/2 + 1/4
}

TEST_CASE("path limits: a sky is seen through a ball that light may enter", "[integrator][path_limits]") {
  const std::vector<glint::Sphere<float>> balls{{.center = {0, 0, -4}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{balls}}, glint::PerfectRefraction{},
                           glint::ConstantEnvironment{Rgb{1}}};
  const Ray<float> ray{.direction = {0.05F, 0, -1}};
  CHECK(estimate(Path{.limits = {.transmissive = 0}}, scene, ray, 4).mean == 0);
  CHECK(estimate(Path{.limits = {.transmissive = 1}}, scene, ray, 4).mean == Approx(1));
}

TEST_CASE("path limits: light is clamped to a largest component, and keeps its color", "[integrator][path_limits]") {
  const LightClamp clamp{.direct = 4, .indirect = 1};
  CHECK(clamp({8, 4, 2}, 1) == Rgb{8, 4, 2});  // seen directly
  CHECK(clamp({8, 4, 2}, 2) == Rgb{4, 2, 1});
  CHECK(clamp({8, 4, 2}, 3) == Rgb{1, 0.5F, 0.25F});
  CHECK(clamp({1, 0.5F, 0}, 3) == Rgb{1, 0.5F, 0});
  CHECK(LightClamp{}({1e30F, 0, 0}, 9) == Rgb{1e30F, 0, 0});
  CHECK_FALSE(is_finite(clamp({std::numeric_limits<float>::infinity(), 0, 0}, 3)));  // still found, and left out
  CHECK_FALSE(LightClamp{}.is_on());
  CHECK(LightClamp{.indirect = 3}.is_on());
}

TEST_CASE("path limits: a path clamps direct and indirect light by limits of their own", "[integrator][path_limits]") {
  // A floor below a point lamp, as it is and in a mirror: 0.5 / π · 8 / 4 = 1 / π, with two segments and with three.
  using Material = glint::OneOf<glint::Lambertian, glint::Mirror>;
  const std::vector<glint::Quad<float>> quads{{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}},
                                              {{-1, 0.1F, -2}, {2, 0, 0}, {0, 2, 0}}};
  const glint::MaterialTable<Material> materials{{glint::Lambertian{Rgb{0.5F}}, glint::Mirror{Rgb{1}}}, {0, 1}};
  const glint::Scene scene{glint::Bvh{glint::Elements{quads}}, materials, glint::PointLight{{0, 2, 0}, Rgb{8}}};
  const auto seen = [&](const LightClamp& clamp, const glint::Vec3<float>& direction, int depth) {
    return estimate(Path{.max_depth = depth, .clamp = clamp}, scene, {.origin = {0, 1, 0}, .direction = direction}, 1)
        .mean;
  };
  const glint::Vec3<float> down{0, -1, 0};
  const glint::Vec3<float> to_mirror{0, -0.25F, -1};
  CHECK(seen({}, down, 2) == Approx(1 / glint::pi<double>));
  CHECK(seen({}, to_mirror, 3) == Approx(1 / glint::pi<double>));
  CHECK(seen({.direct = 0.125F}, down, 2) == Approx(0.125));
  CHECK(seen({.direct = 0.125F}, to_mirror, 3) == Approx(1 / glint::pi<double>));
  CHECK(seen({.indirect = 0.125F}, down, 2) == Approx(1 / glint::pi<double>));
  CHECK(seen({.indirect = 0.125F}, to_mirror, 3) == Approx(0.125));
}

}  // namespace test_integrator_path_limits

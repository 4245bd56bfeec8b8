// SPDX-License-Identifier: MIT
#include <glint/integrator/intersection_test.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/material_table.hpp>

namespace test_integrator_intersection_test {

using glint::Falloff;
using glint::IntersectionTest;
using glint::Lambertian;
using glint::PerfectRefraction;
using glint::PointLight;
using glint::Ray;
using glint::Rgb;

namespace {

using Material = glint::OneOf<Lambertian, PerfectRefraction>;

/// A floor at y = −1, seen straight down from the origin, with a lamp three units above it.
const std::vector<glint::Quad<float>> floor_below{{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}};
const PointLight lamp{{0, 2, 0}, Rgb{6}};
const Ray<float> down{.direction = {0, -1, 0}};
const glint::Scene lit_floor{glint::Bvh{glint::Elements{floor_below}}, Lambertian{Rgb{0.5F}}, lamp};

}  // namespace

TEST_CASE("intersection test: a floor under a lamp is ρ/π · I · F(r)", "[integrator][intersection_test]") {
  const double base = 0.5 / glint::pi<double> * 6;  // r = 3
  CHECK(estimate(IntersectionTest{}, lit_floor, down, 1).mean == Approx(base / 9));
  CHECK(estimate(IntersectionTest{.falloff = Falloff::None}, lit_floor, down, 1).mean == Approx(base));
  CHECK(estimate(IntersectionTest{.falloff = Falloff::Square}, lit_floor, down, 1).mean == Approx(base * 9));
}

TEST_CASE("intersection test: several lamps add up", "[integrator][intersection_test]") {
  const glint::Lights<PointLight> lamps{{lamp, lamp, PointLight{{0, 2, 0}, Rgb{12}}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{floor_below}}, Lambertian{Rgb{0.5F}}, lamps};
  CHECK(estimate(IntersectionTest{}, scene, down, 1).mean ==
        Approx(4 * estimate(IntersectionTest{}, lit_floor, down, 1).mean));
}

TEST_CASE("intersection test: whatever stands before the lamp throws a shadow, glass too",
          "[integrator][intersection_test]") {
  const std::vector<glint::Sphere<float>> ball{{.center = {0, 1, 0}, .radius = 0.25F}};
  const glint::Joined shapes{glint::Elements{floor_below}, glint::Elements{ball}};
  const glint::MaterialTable<Material> materials{{Lambertian{Rgb{0.5F}}, PerfectRefraction{}}, {0, 1}};
  const glint::Scene scene{glint::Bvh{shapes}, materials, lamp};
  CHECK(estimate(IntersectionTest{}, scene, down, 1).mean == 0);
}

TEST_CASE("intersection test: a pane of glass in front of the camera changes nothing straight on",
          "[integrator][intersection_test]") {
  auto quads = floor_below;
  quads.push_back({{-1, -0.5F, -1}, {0, 0, 2}, {2, 0, 0}});  // aside of the line from the floor to the lamp
  quads.back().origin.x = 1.1F;
  const glint::MaterialTable<Material> materials{{Lambertian{Rgb{0.5F}}, PerfectRefraction{.eta = 2}}, {0, 1}};
  const glint::Scene scene{glint::Bvh{glint::Elements{quads}}, materials, lamp};
  const Ray<float> ray{.origin = {1.2F, 0, 0}, .direction = {0, -1, 0}};
  const auto expected = estimate(IntersectionTest{}, lit_floor, ray, 1).mean;
  CHECK(estimate(IntersectionTest{}, scene, ray, 1).mean == Approx(expected).epsilon(1e-4));
  CHECK(estimate(IntersectionTest{.max_depth = 1}, scene, ray, 1).mean == 0);  // the pane was all it might meet
}

TEST_CASE("intersection test: what shines is seen, and lights directly", "[integrator][intersection_test]") {
  const Furnace furnace;
  const auto [mean, error] = estimate(IntersectionTest{}, furnace.scene(0.5F), Ray<float>{}, 20'000);
  CHECK(std::abs(mean - 1.5) <= 4 * error);  // emission and one bounce: 1 + ρ
}

TEST_CASE("intersection test: an environment is seen past everything and lights the rest",
          "[integrator][intersection_test]") {
  const glint::Scene scene{glint::Bvh{glint::Elements{floor_below}}, Lambertian{Rgb{0.5F}},
                           glint::ConstantEnvironment{Rgb{2}}};
  CHECK(estimate(IntersectionTest{}, scene, Ray<float>{.direction = {0, 1, 0}}, 1).mean == 2);
  const auto [mean, error] = estimate(IntersectionTest{}, scene, down, 40'000);
  CHECK(std::abs(mean - 1) <= 4 * error);  // ρ L
}

}  // namespace test_integrator_intersection_test

// SPDX-License-Identifier: MIT
#include <glint/geometry/set/filtered.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <vector>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_geometry_set_filtered {

using glint::Elements;
using glint::Filtered;
using glint::Ray;
using glint::Sphere;

TEMPLATE_TEST_CASE("filtered: behind the near side of a sphere that is rejected, its far side is hit", "[geometry]",
                   float, double) {
  using T = TestType;
  const std::vector<Sphere<T>> spheres{{{T(0), T(0), T(0)}, T(1)}};
  // The ray comes from z = 3: it enters at t = 2 and leaves at t = 4.
  const Filtered set{Elements{spheres}, [](const auto& ray, const auto& hit) { return ray.at(hit.t).z < T(0); }};
  static_assert(glint::ShadableSet<decltype(set)>);
  const Ray<T> ray{.origin = {T(0), T(0), T(3)}};
  const auto hit = set.intersect(ray, 0);
  REQUIRE(hit);
  CHECK(hit->t == Approx(4));
  CHECK(hit->primitive == 0);
  Ray<T> short_ray = ray;
  short_ray.t_max = T(3);
  CHECK_FALSE(set.intersect(short_ray, 0));
  CHECK(set.size() == 1);
  CHECK(set.bounds(0) == set.set().bounds(0));
  CHECK(set.surface(ray, *hit).position.z == Approx(-1));
}

TEST_CASE("filtered: a set that prepares rays does so behind a filter", "[geometry]") {
  const auto buffers = glint::testing::identical_triangles<float>(2);
  const auto mesh = view(buffers);
  const Filtered set{mesh, [](const auto& /*ray*/, const auto& hit) { return hit.primitive != 0; }};
  const Ray<float> ray{.origin = {0, 0, 3}};
  REQUIRE(mesh.intersect(ray, 0));
  CHECK_FALSE(set.intersect(ray, 0));
  CHECK(set.intersect(ray, 1) == mesh.intersect(ray, 1));
  static_assert(glint::PreparedSet<decltype(set)>);
  CHECK_FALSE(set.intersect(ray, set.prepare(ray), 0));
  CHECK(set.intersect(ray, set.prepare(ray), 1) == mesh.intersect(ray, 1));
}

}  // namespace test_geometry_set_filtered

// SPDX-License-Identifier: MIT
#include <glint/bvh/brute_force.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <vector>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

#include <support/catch.hpp>

namespace test_bvh_brute_force {

using glint::BruteForce;
using glint::Elements;
using glint::Sphere;

TEMPLATE_TEST_CASE("brute force: finds the closest of all, and of equals the first", "[bvh]", float, double) {
  using T = TestType;
  const std::vector<Sphere<T>> shapes{{{0, 0, -9}, 1}, {{0, 0, -5}, 1}, {{0, 0, -5}, 1}};
  const BruteForce all(Elements{shapes});
  static_assert(glint::RayCaster<BruteForce<Elements<Sphere<T>>>>);
  const auto hit = all.closest({});
  REQUIRE(hit);
  CHECK(hit->t == 4);
  CHECK(hit->primitive == 1);
  CHECK(all.occluded({.t_max = T(4)}));
  CHECK_FALSE(all.occluded({.t_max = T(3.5)}));
  CHECK_FALSE(all.closest({.direction = {1, 0, 0}}));
  CHECK(all.bounds() == glint::Aabb<T>{{-1, -1, -10}, {1, 1, -4}});
  CHECK(all.surface({}, *hit).normal == glint::Vec3<T>{0, 0, 1});
  CHECK(all.set().size() == 3);
}

TEST_CASE("brute force: a primitive without a finite box is never hit", "[bvh]") {
  const std::vector<Sphere<float>> shapes{{{0, 0, -5}, std::numeric_limits<float>::infinity()}, {{0, 0, -9}, 1}};
  const BruteForce all(Elements{shapes});
  CHECK(all.closest({})->primitive == 1);
  CHECK(all.bounds().upper.z == -8);
}

}  // namespace test_bvh_brute_force

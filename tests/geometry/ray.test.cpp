// SPDX-License-Identifier: MIT
#include <glint/geometry/ray.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_geometry_ray {

TEMPLATE_TEST_CASE("ray: t counts multiples of the direction", "[geometry][ray]", float, double) {
  const glint::Ray<TestType> ray{.origin = {1, 2, 3}, .direction = {0, 0, 2}};
  CHECK(ray.at(0) == glint::Vec3<TestType>{1, 2, 3});
  CHECK(ray.at(1.5) == glint::Vec3<TestType>{1, 2, 6});
}

TEMPLATE_TEST_CASE("ray: the default starts at the origin, looks along -z and never ends", "[geometry][ray]", float,
                   double) {
  const glint::Ray<TestType> ray;
  CHECK(ray.direction == glint::Vec3<TestType>{0, 0, -1});
  CHECK(ray.t_min == 0);
  CHECK(ray.t_max == glint::infinity<TestType>);
}

}  // namespace test_geometry_ray

// SPDX-License-Identifier: MIT
#include <glint/geometry/cylinder.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/closest_points.hpp>
#include <support/solids.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bounds_laws.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_cylinder {

static_assert(glint::ShadablePrimitive<glint::Cylinder<float>> && glint::SampleablePrimitive<glint::Cylinder<double>> &&
              glint::ClosestPointPrimitive<glint::Cylinder<float>>);

TEMPLATE_TEST_CASE("cylinder: is hit on its side and on its caps, if it has any", "[geometry][cylinder]", float,
                   double) {
  using T = TestType;
  const glint::Cylinder<T> can{.base = {0, 0, -1}, .top = {0, 0, 3}, .radius = 2};
  glint::Cylinder<T> pipe = can;
  pipe.ends = glint::Ends::Open;
  const auto t = [](const glint::Ray<T>& ray, const glint::Cylinder<T>& c) {
    const auto hit = intersect(ray, c);
    return hit ? hit->t : T(-1);
  };
  CHECK(t({.origin = {5, 0, 1}, .direction = {-2, 0, 0}}, can) == T(1.5));
  CHECK(t({.origin = {5, 0, 1}, .direction = {-2, 0, 0}}, pipe) == T(1.5));
  CHECK(t({.origin = {1, 0, 9}, .direction = {0, 0, -2}}, can) == T(3));
  CHECK(t({.origin = {1, 0, 9}, .direction = {0, 0, -2}}, pipe) == T(-1));
  CHECK(t({.origin = {1, 0, 1}, .direction = {0, 0, 1}}, can) == T(2));
  // in at the open end, out at the side: from (0, 0, 5) along (1, 0, −1) to x = 2
  CHECK(t({.origin = {0, 0, 5}, .direction = {1, 0, -2}}, pipe) == T(2));
  CHECK(t({.origin = {0, 0, 5}, .direction = {1, 0, -2}}, can) == T(1));
}

TEST_CASE("cylinder: a hair far away keeps its precision", "[geometry][cylinder]") {
  using Vec3d = glint::Vec3<double>;
  glint::Random random(4);
  const glint::Cylinder<float> hair{.base = {800, 300, -500}, .top = {800, 301, -500}, .radius = 0.01F};
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const glint::Vec3<float> target{800 + random.uniform(-0.008F, 0.008F), 300 + random.uniform(0.1F, 0.9F), -500};
    const auto hit = intersect(glint::Ray<float>{.direction = target}, hair);
    const auto exact = intersect(glint::Ray<double>{.direction = Vec3d(target)},
                                 glint::Cylinder<double>{Vec3d(hair.base), Vec3d(hair.top), double(hair.radius)});
    REQUIRE(hit.has_value() == exact.has_value());
    if (!hit) continue;
    ++hits;
    CHECK(std::abs(double(hit->t) - exact->t) <= 8 * double(std::numeric_limits<float>::epsilon()));
  }
  CHECK(hits > 1000);
}

TEMPLATE_TEST_CASE("cylinder: obeys the laws of Primitive, in tight bounds", "[geometry][cylinder][laws]", float,
                   double) {
  using T = TestType;
  const auto seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  for (const auto& shape : {glint::Cylinder<T>{}, glint::Cylinder<T>{{1, 2, 3}, {T(1.5), 0, 4}, T(0.4)},
                            glint::Cylinder<T>{{0, 2, 0}, {0, -1, 0}, T(1.4), glint::Ends::Open}}) {
    CHECK(glint::testing::violations_of_primitive_laws(shape, seed) == std::vector<std::string>{});
    if (seed == 0) CHECK(glint::testing::violations_of_tight_bounds(shape, seed) == std::vector<std::string>{});
  }
}

TEMPLATE_TEST_CASE("cylinder: area, box and closest points are those of the textbook", "[geometry][cylinder]", float,
                   double) {
  using T = TestType;
  glint::Cylinder<T> shape{.base = {0, 0, -1}, .top = {0, 0, 1}, .radius = T(0.5)};
  CHECK(area(shape) == Approx(2 * glint::pi<double> * 0.5 * 2 + 2 * glint::pi<double> * 0.25));
  CHECK(bounds(shape) == glint::Aabb<T>{{T(-0.5), T(-0.5), -1}, {T(0.5), T(0.5), 1}});
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
  shape.ends = glint::Ends::Open;
  CHECK(area(shape) == Approx(2 * glint::pi<double> * 0.5 * 2));
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_cylinder

// SPDX-License-Identifier: MIT
#include <glint/geometry/quad.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_quad {

static_assert(glint::ShadablePrimitive<glint::Quad<float>> && glint::SampleablePrimitive<glint::Quad<double>>);

TEMPLATE_TEST_CASE("quad: a hit's uv are the fractions along its edges", "[geometry][quad]", float, double) {
  using T = TestType;
  const glint::Quad<T> quad{.origin = {1, 1, -4}, .edge_u = {4, 0, 0}, .edge_v = {2, 2, 0}};
  // (1, 1) + 1/4 · (4, 0) + 1/2 · (2, 2) = (3, 2)
  const auto front = intersect(glint::Ray<T>{.origin = {3, 2, 0}, .direction = {0, 0, -2}}, quad);
  REQUIRE(front);
  CHECK(*front == glint::Hit<T>{.t = 2, .uv = {T(0.25), T(0.5)}});
  const auto back = intersect(glint::Ray<T>{.origin = {3, 2, -5}, .direction = {0, 0, 1}}, quad);
  REQUIRE(back);
  CHECK(*back == glint::Hit<T>{.t = 1, .uv = {T(0.25), T(0.5)}});
}

TEMPLATE_TEST_CASE("quad: its edges and corners are part of it, an ulp further is not", "[geometry][quad]", float,
                   double) {
  using T = TestType;
  const T beyond = T(1) + std::numeric_limits<T>::epsilon();
  const auto is_hit = [](T x, T y) {
    return intersect(glint::Ray<T>{.origin = {x, y, 1}}, glint::Quad<T>{}).has_value();
  };
  for (const T x : {T(0), T(0.5), T(1)}) {
    for (const T y : {T(0), T(0.5), T(1)}) CHECK(is_hit(x, y));
    CHECK_FALSE(is_hit(x, beyond));
    CHECK_FALSE(is_hit(beyond, x));
    CHECK_FALSE(is_hit(x, -std::numeric_limits<T>::min()));
    CHECK_FALSE(is_hit(-std::numeric_limits<T>::min(), x));
  }
}

TEMPLATE_TEST_CASE("quad: is not hit along its plane, without area, or with a NaN", "[geometry][quad]", float, double) {
  using T = TestType;
  using Q = glint::Quad<T>;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {-1, T(0.5), 0}, .direction = {1, 0, 0}}, Q{}));
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {0, 0, 0}, .direction = {1, 0, 0}}, Q{}));
  glint::Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const auto edge = random.template uniform_vec3<T>();
    const glint::Ray<T> ray{.origin = {0, 0, 5},
                            .direction = edge * random.template uniform<T>() - glint::Vec3<T>(0, 0, 5)};
    CHECK_FALSE(intersect(ray, Q{.edge_u = edge, .edge_v = edge * T(2)}));
    CHECK_FALSE(intersect(ray, Q{.edge_u = edge, .edge_v = glint::Vec3<T>(T(0))}));
    CHECK_FALSE(intersect(ray, Q{.edge_u = glint::Vec3<T>(T(0)), .edge_v = edge}));
  }
  const glint::Ray<T> ray{.origin = {T(0.5), T(0.5), 1}};
  REQUIRE(intersect(ray, Q{}));
  CHECK_FALSE(intersect(ray, Q{.origin = {nan, 0, 0}}));
  CHECK_FALSE(intersect(ray, Q{.edge_u = {1, nan, 0}}));
  CHECK_FALSE(intersect(ray, Q{.edge_v = {0, 1, nan}}));
  const T inf = glint::infinity<T>;
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {T(0.5), T(0.5), 1}, .direction = {0, 0, -inf}}, Q{}));
}

TEMPLATE_TEST_CASE("quad: its box is exact, flat where it is", "[geometry][quad]", float, double) {
  using T = TestType;
  const glint::Quad<T> quad{.origin = {1, 1, -4}, .edge_u = {4, 0, 0}, .edge_v = {-2, 2, 0}};
  CHECK(bounds(quad) == glint::Aabb<T>{{-1, 1, -4}, {5, 3, -4}});
}

TEMPLATE_TEST_CASE("quad: its outer side is where edge_u × edge_v points", "[geometry][quad]", float, double) {
  using T = TestType;
  const glint::Quad<T> floor{.origin = {0, 0, 0}, .edge_u = {0, 0, 3}, .edge_v = {2, 0, 0}};
  const auto hit = intersect(glint::Ray<T>{.origin = {1, -1, 1}, .direction = {0, 1, 0}}, floor);
  REQUIRE(hit);
  const auto at = surface(floor, glint::Vec3<T>(1, 0, 1), *hit);
  CHECK(at.normal == glint::Vec3<T>(0, 1, 0));
  CHECK(at.shading_normal == at.normal);
  CHECK(at.tangent == floor.edge_u);
  CHECK(at.uv == hit->uv);
  CHECK(at.position_error.y > T(0));  // though every y is zero: rays that start here must get off the plane
  CHECK(area(floor) == T(6));
}

TEST_CASE("quad: the error bound holds in single precision, wherever the quad is", "[geometry][quad]") {
  glint::Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const float reach = std::exp2(random.uniform(-20.0F, 20.0F));
    const glint::Quad<float> quad{.origin = (random.uniform_vec3<float>() - 0.5F) * reach,
                                  .edge_u = random.uniform_vec3<float>() - 0.5F,
                                  .edge_v = random.uniform_vec3<float>() - 0.5F};
    const auto at = sample_area(quad, random.uniform_vec2<float>()).surface;
    using Vec3d = glint::Vec3<double>;
    const auto exact = Vec3d(quad.origin) + Vec3d(quad.edge_u) * double(at.uv.x) + Vec3d(quad.edge_v) * double(at.uv.y);
    const auto off = glint::abs(exact - Vec3d(at.position));
    REQUIRE(off.x <= double(at.position_error.x));
    REQUIRE(off.y <= double(at.position_error.y));
    REQUIRE(off.z <= double(at.position_error.z));
  }
}

TEMPLATE_TEST_CASE("quad: obeys the laws of Primitive", "[geometry][quad][laws]", float, double) {
  using T = TestType;
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  CHECK(glint::testing::violations_of_primitive_laws(glint::Quad<T>{}, seed) == std::vector<std::string>{});
  const glint::Quad<T> slanted{.origin = {3, -2, 1}, .edge_u = {T(0.3), 2, 1}, .edge_v = {-1, T(0.1), T(1.7)}};
  CHECK(glint::testing::violations_of_primitive_laws(slanted, seed) == std::vector<std::string>{});
  const glint::Quad<T> tiny{.origin = {0, 0, 0}, .edge_u = {T(2e-6), 0, 0}, .edge_v = {0, 0, T(1e-6)}};
  CHECK(glint::testing::violations_of_primitive_laws(tiny, seed) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("quad: no point of it is closer than its closest point", "[geometry][quad]", float, double) {
  using T = TestType;
  const glint::Quad<T> shape{.origin = {-1, -1, T(0.5)}, .edge_u = {2, T(0.5), 0}, .edge_v = {T(1.5), 1, T(-0.5)}};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_quad

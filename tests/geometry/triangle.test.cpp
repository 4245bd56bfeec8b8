// SPDX-License-Identifier: MIT
#include <glint/geometry/triangle.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <glint/geometry/clip.hpp>
#include <glint/geometry/concepts.hpp>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

namespace test_geometry_triangle {

namespace {

using glint::Triangle;
using glint::Vec3;

static_assert(glint::ShadablePrimitive<Triangle<float>> && glint::SampleablePrimitive<Triangle<double>>);
static_assert(glint::ClippablePrimitive<Triangle<float>>);

template <typename T>
Triangle<T> example() {
  return {{T(1), T(0), T(0)}, {T(5), T(0), T(0)}, {T(1), T(3), T(0)}};  // legs 4 and 3, in the plane z = 0
}

}  // namespace

TEMPLATE_TEST_CASE("triangle: has the area and the box of its vertices", "[geometry][triangle]", float, double) {
  using T = TestType;
  const T size = std::ldexp(T(1), GENERATE(-60, 0, 50));  // powers of two: exact; the square of the area may underflow
  Triangle<T> t = example<T>();
  for (Vec3<T>* v : {&t.v0, &t.v1, &t.v2}) *v *= size;
  CHECK(area(t) == Approx(double(T(6) * size * size)).epsilon(1e-6));
  CHECK(bounds(t) == glint::Aabb<T>{{size, T(0), T(0)}, {T(5) * size, T(3) * size, T(0)}});
  CHECK(area(Triangle<T>{t.v0, t.v0, t.v1}) == T(0));
}

TEMPLATE_TEST_CASE("triangle: has in a cell what its corners and the cell leave", "[geometry][triangle]", float,
                   double) {
  using T = TestType;
  const glint::Aabb<T> cell{Vec3<T>(T(0)), {T(3), T(9), T(0)}};
  const auto part = clip(example<T>(), cell);
  CHECK(part == glint::clipped_bounds(std::array{example<T>().v0, example<T>().v1, example<T>().v2}, cell));
  CHECK(part.upper == Vec3<T>{T(3), T(3), T(0)});
}

TEMPLATE_TEST_CASE("triangle: a hit's surface has the weights' position, uv, tangent and the winding's normal",
                   "[geometry][triangle]", float, double) {
  using T = TestType;
  const Triangle<T> t = example<T>();
  const glint::Ray<T> ray{{T(2), T(1.5), T(7)}, {T(0), T(0), T(-1)}};  // x = 1 + 4 w1, y = 3 w2
  const auto hit = intersect(ray, t);
  REQUIRE(hit);
  CHECK(hit->t == T(7));
  CHECK(hit->uv == glint::Vec2<T>{T(0.25), T(0.5)});
  const glint::SurfaceOf<T> s = surface(t, ray.at(hit->t), *hit);
  CHECK(s.position == Vec3<T>{T(2), T(1.5), T(0)});
  CHECK(s.normal == Vec3<T>{T(0), T(0), T(1)});
  CHECK(s.shading_normal == s.normal);
  CHECK(s.tangent == Vec3<T>{T(4), T(0), T(0)});
  CHECK(s.uv == glint::Vec2<T>{T(0.75), T(0.5)});  // w1 (1, 0) + w2 (1, 1)
  const glint::SurfaceOf<T> back = surface(Triangle<T>{t.v0, t.v2, t.v1}, ray.at(hit->t), *hit);
  CHECK(back.normal == Vec3<T>{T(0), T(0), T(-1)});
}

TEMPLATE_TEST_CASE("triangle: the tangent is the derivative of the position by u", "[geometry][triangle]", float,
                   double) {
  using T = TestType;
  const Triangle<T> t{{T(0), T(1), T(2)}, {T(2), T(1), T(0)}, {T(1), T(3), T(1)}};
  // Along v = w2 = const, u grows with w1 alone.
  const auto a = surface_at(t, T(0.25), T(0.25));
  const auto b = surface_at(t, T(0.5), T(0.25));
  CHECK(b.uv - a.uv == glint::Vec2<T>{T(0.25), T(0)});
  CHECK(b.position - a.position == a.tangent * T(0.25));
}

TEMPLATE_TEST_CASE("triangle: position_error bounds the distance to the exact point", "[geometry][triangle]", float,
                   double) {
  using T = TestType;
  using Exact = glm::vec<3, long double, glm::packed_highp>;
  std::mt19937 random(21);
  std::uniform_real_distribution<T> uniform(T(-1), T(1));
  const auto point = [&] { return Vec3<T>{uniform(random), uniform(random), uniform(random)}; };
  int outside = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3<T> place = point() * T(i % 2 == 0 ? 1000 : 0);
    const Triangle<T> t{place + point(), place + point(), place + point()};
    const T w1 = std::abs(uniform(random)) / 2;
    const T w2 = std::abs(uniform(random)) / 2;
    const auto s = surface_at(t, w1, w2);
    const Exact exact = Exact(t.v0) + (Exact(t.v1) - Exact(t.v0)) * static_cast<long double>(w1) +
                        (Exact(t.v2) - Exact(t.v0)) * static_cast<long double>(w2);
    const Exact error = glm::abs(Exact(s.position) - exact);
    outside += error.x > s.position_error.x || error.y > s.position_error.y || error.z > s.position_error.z ? 1 : 0;
  }
  CHECK(outside == 0);
}

TEMPLATE_TEST_CASE("triangle: samples are uniform by area", "[geometry][triangle]", float, double) {
  using T = TestType;
  const Triangle<T> t = example<T>();
  // Cutting each edge in half gives four triangles of equal area; a regular grid of u gives each of them a quarter.
  std::array<int, 4> counts{};
  const int n = 200;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto sample = sample_area(t, glint::Vec2<T>{(T(i) + T(0.5)) / T(n), (T(j) + T(0.5)) / T(n)});
      CHECK(sample.pdf == Approx(1.0 / 6));
      const T w1 = (sample.surface.position.x - T(1)) / T(4);
      const T w2 = sample.surface.position.y / T(3);
      const T w0 = T(1) - w1 - w2;
      REQUIRE((w0 > T(-1e-6) && w1 > T(-1e-6) && w2 > T(-1e-6)));
      ++counts[w0 > T(0.5) ? 0 : w1 > T(0.5) ? 1 : w2 > T(0.5) ? 2 : 3];
    }
  }
  // Cells that the cuts pass through may fall on either side: at most a row of n cells for each of three cuts.
  for (const int count : counts) CHECK(std::abs(count - n * n / 4) <= 3 * n);
  const auto none = sample_area(Triangle<T>{}, glint::Vec2<T>{T(0.5), T(0.5)});
  CHECK(none.pdf == T(0));
}

TEMPLATE_TEST_CASE("triangle: without area or with a NaN it is never hit", "[geometry][triangle]", float, double) {
  using T = TestType;
  const glint::Ray<T> ray{{T(2), T(0), T(1)}, {T(0), T(0), T(-1)}};
  REQUIRE(intersect(ray, example<T>()));  // through an edge
  CHECK_FALSE(intersect(ray, Triangle<T>{{T(1), T(0), T(0)}, {T(5), T(0), T(0)}, {T(3), T(0), T(0)}}));
  Triangle<T> broken = example<T>();
  broken.v2.x = std::numeric_limits<T>::quiet_NaN();
  CHECK_FALSE(intersect(ray, broken));
}

TEMPLATE_TEST_CASE("triangle: no point of it is closer than its closest point", "[geometry][triangle]", float, double) {
  using T = TestType;
  const glint::Triangle<T> shape{{-1, 0, T(0.5)}, {T(1.5), T(0.25), 0}, {0, 2, -1}};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
  const glint::Triangle<T> segment{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}};  // no area: what its edges are
  CHECK(closest_point(glint::Vec3<T>(2, 5, 0), segment) == glint::Vec3<T>(2, 0, 0));
}

TEMPLATE_TEST_CASE("triangle: a sliver's closest point is closest to rounding", "[geometry][triangle]", float, double) {
  using T = TestType;
  // Coordinates are below 8, and what is found is a few roundings of them off.
  const long double slack = 8 * std::numeric_limits<T>::epsilon();
  for (const auto& [point, triangle] : glint::testing::points_over_slivers<T>(4800)) {
    CAPTURE(point.x, point.y, point.z, triangle.v0.x, triangle.v1.x, triangle.v2.x);
    const Vec3<T> found = closest_point(point, triangle);
    const Vec3<long double> way = Vec3<long double>(found) - Vec3<long double>(point);
    const long double least = glint::testing::distance_by_slices(point, triangle);
    REQUIRE(std::abs(std::sqrt(glint::length_squared(way)) - least) <= slack);
    REQUIRE(glint::testing::distance_by_slices(found, triangle) <= slack);
  }
}

}  // namespace test_geometry_triangle

// SPDX-License-Identifier: MIT
#include <glint/geometry/cone.hpp>  // first, so the header proves it stands alone

#include <algorithm>
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

namespace test_geometry_cone {

static_assert(glint::ShadablePrimitive<glint::Cone<float>> && glint::SampleablePrimitive<glint::Cone<double>> &&
              glint::ClosestPointPrimitive<glint::Cone<float>>);

namespace {

using Vec3d = glint::Vec3<double>;

template <typename T>
std::vector<glint::Cone<T>> cones() {
  using glint::Ends;
  return {{},
          {.base = {1, -2, 3}, .top = {2, 1, T(2.5)}, .base_radius = T(0.5), .top_radius = T(1.5)},
          {.base = {1, -2, 3}, .top = {2, 1, T(2.5)}, .base_radius = T(1.5), .top_radius = T(0.5), .ends = Ends::Open},
          {.base = {0, 0, 1}, .top = {1, 0, 1}, .base_radius = 0, .top_radius = 2},
          {.base = {0, 1, 0}, .top = {0, -1, 0}, .base_radius = 1, .top_radius = 1},
          {.base = {T(1e-6), 0, 0}, .top = {0, T(2e-6), 0}, .base_radius = T(1e-6), .top_radius = T(5e-7)},
          {.base = {T(1e6), 0, 0}, .top = {0, T(2e6), T(1e6)}, .base_radius = T(1e6), .top_radius = T(5e5)}};
}

/// Below 0 inside of the capped cone, above outside; in double precision, and from the definition.
template <typename T>
double solid(const glint::Cone<T>& cone, const Vec3d& p) {
  const Vec3d axis = Vec3d(cone.top) - Vec3d(cone.base);
  const double height = glm::length(axis);
  const Vec3d local = p - Vec3d(cone.base);
  const double z = glm::dot(local, axis) / height;
  const double distance = glm::length(local - axis * (z / height));
  const double f = z / height;
  const double radius = double(cone.base_radius) * (1 - f) + double(cone.top_radius) * f;
  const double slope = (double(cone.top_radius) - double(cone.base_radius)) / height;
  return std::max({(distance - radius) / std::sqrt(1 + slope * slope), -z, z - height});
}

}  // namespace

TEMPLATE_TEST_CASE("cone: rays along and across its axis meet what the drawing says", "[geometry][cone]", float,
                   double) {
  using T = TestType;
  const glint::Cone<T> cone{.base = {0, 0, 0}, .top = {0, 0, 2}, .base_radius = 2, .top_radius = 1};
  const auto t = [&](const glint::Ray<T>& ray, glint::Ends ends) {
    glint::Cone<T> shape = cone;
    shape.ends = ends;
    const auto hit = intersect(ray, shape);
    return hit ? hit->t : T(-1);
  };
  using glint::Ends;
  // at half the height the radius is 1.5
  CHECK(t({.origin = {5, 0, 1}, .direction = {-1, 0, 0}}, Ends::Capped) == T(3.5));
  CHECK(t({.origin = {0, 0, 1}, .direction = {-1, 0, 0}}, Ends::Open) == T(1.5));
  CHECK(t({.origin = {0, 0, 9}, .direction = {0, 0, -2}}, Ends::Capped) == T(3.5));
  CHECK(t({.origin = {0, 0, 9}, .direction = {0, 0, -2}}, Ends::Open) == T(-1));
  CHECK(t({.origin = {0, 0, 1}, .direction = {0, 0, -2}}, Ends::Capped) == T(0.5));
  CHECK(t({.origin = {1.5, 0, 9}, .direction = {0, 0, -1}}, Ends::Open) == T(8));  // along the axis onto the slope
  CHECK(t({.origin = {5, 0, T(2.001)}, .direction = {-1, 0, 0}}, Ends::Capped) == T(-1));
}

TEMPLATE_TEST_CASE("cone: a ray parallel to the side meets it once", "[geometry][cone]", float, double) {
  using T = TestType;
  const glint::Cone<T> cone{.base = {0, 0, 0}, .top = {0, 0, 2}, .base_radius = 2, .top_radius = 0};
  // The side's generator at y = 0, x < 0 runs along (1, 0, 1); from (3, 0, 1) backward the other side x = 2 − z is met
  // where 3 − t = 2 − (1 − t): t = 1.
  const auto hit = intersect(glint::Ray<T>{.origin = {3, 0, 1}, .direction = {-1, 0, -1}}, cone);
  REQUIRE(hit);
  CHECK(hit->t == Approx(1));
  CHECK(hit->uv.x == T(0));
  const auto out = intersect(glint::Ray<T>{.origin = {T(0.5), 0, T(0.5)}, .direction = {-1, 0, -1}}, cone);
  REQUIRE(out);
  CHECK(out->t == Approx(0.5));  // leaves by the base
  CHECK(out->uv.x == T(1));
}

TEMPLATE_TEST_CASE("cone: beyond the apex there is nothing", "[geometry][cone]", float, double) {
  using T = TestType;
  const glint::Cone<T> cone{.base = {0, 0, 0}, .top = {0, 0, 1}, .base_radius = 1, .top_radius = 0};
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {5, 0, T(1.5)}, .direction = {-1, 0, 0}}, cone));
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {5, 0, T(1.5)}, .direction = {-1, 0, T(0.1)}}, cone));
  const auto steep = intersect(glint::Ray<T>{.origin = {T(0.1), 0, 3}, .direction = {0, 0, -1}}, cone);
  REQUIRE(steep);
  CHECK(steep->t == Approx(2.1));  // where the radius is 0.1: z = 0.9
}

TEMPLATE_TEST_CASE("cone: agrees with a walk along the ray in small steps", "[geometry][cone]", float, double) {
  using T = TestType;
  for (const auto& cone : cones<T>()) {
    if (cone.ends == glint::Ends::Open) continue;
    const auto box = bounds(cone);
    const T size = glm::length(extent(box));
    int hits = 0;
    for (const auto& ray : glint::testing::rays_into(box, 300, 5)) {
      const glint::Ray<double> exact{Vec3d(ray.origin), Vec3d(ray.direction)};
      const double t_max = 3 * double(size) / glm::length(exact.direction);
      const auto expected =
          glint::testing::first_sign_change(exact, t_max, [&](const Vec3d& p) { return solid(cone, p); });
      const auto hit = intersect(ray, cone);
      if (!expected || !hit) {
        // the walk may step over a corner that is thinner than a step
        if (expected.has_value() != hit.has_value()) {
          REQUIRE(hit);
          REQUIRE(std::abs(solid(cone, exact.at(double(hit->t)))) < 1e-5 * double(size));
        }
        continue;
      }
      ++hits;
      const double rounding = double(std::numeric_limits<T>::epsilon()) * double(size);
      if (std::abs(double(hit->t) - *expected) * glm::length(exact.direction) < 100 * rounding) continue;
      REQUIRE(std::abs(solid(cone, exact.at(double(hit->t)))) < 30 * rounding);  // grazing: t is soft, the point is not
    }
    CHECK(hits > 80);
  }
}

TEST_CASE("cone: small and far away, points in single precision are on the surface", "[geometry][cone]") {
  glint::Random random(2);
  const glint::Cone<float> cone{
      .base = {1e4F, 2e3F, -3e3F}, .top = {1e4F, 2e3F + 0.25F, -3e3F}, .base_radius = 0.125F, .top_radius = 0.0625F};
  int hits = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto target = cone.base + (random.uniform_vec3<float>() - 0.5F) * 0.1F + glint::Vec3<float>(0, 0.1F, 0);
    const glint::Ray<float> ray{.direction = target};
    const auto hit = intersect(ray, cone);
    const auto exact = intersect(glint::Ray<double>{.direction = Vec3d(target)},
                                 glint::Cone<double>{Vec3d(cone.base), Vec3d(cone.top), 0.125, 0.0625});
    if (!exact || !hit) continue;
    ++hits;
    // a few roundings of t near 1, which are 10³ times the error b² − ac would have left of a radius of 0.1
    CHECK(std::abs(double(hit->t) - exact->t) <= 8 * double(std::numeric_limits<float>::epsilon()));
  }
  CHECK(hits > 1500);
}

TEMPLATE_TEST_CASE("cone: is not hit without height or radius, or with a NaN", "[geometry][cone]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Ray<T> ray{.origin = {T(0.1), 0, 4}, .direction = {0, 0, -1}};
  REQUIRE(intersect(ray, glint::Cone<T>{}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.top = {0, 0, 0}}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.base_radius = 0}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.base_radius = -1}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.base_radius = nan}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.top_radius = nan}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.base = {nan, 0, 0}}));
  CHECK_FALSE(intersect(ray, glint::Cone<T>{.top = {0, nan, 1}}));
}

TEMPLATE_TEST_CASE("cone: no line slips through the rim where side and cap meet", "[geometry][cone]", float, double) {
  using T = TestType;
  const glint::Cone<T> cone{.base = {1, 2, 3}, .top = {2, 4, 2}, .base_radius = T(0.7), .top_radius = T(0.3)};
  const glint::Frame<T> frame = glint::Frame<T>::around(glm::normalize(cone.top - cone.base));
  glint::Random random(3);
  int inner = 0;
  for (int i = 0; i < 20000; ++i) {
    const T phi = random.uniform(T(0), T(6.283));
    const auto rim = cone.base + (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * cone.base_radius;
    const auto from = cone.base + (cone.top - cone.base) * random.uniform(T(0.2), T(0.8));
    if (intersect(glint::Ray<T>{.origin = from, .direction = rim - from}, cone)) ++inner;  // from within: always
  }
  CHECK(inner == 20000);
}

TEST_CASE("cone: the error bound holds in single precision, wherever the cone is", "[geometry][cone]") {
  glint::Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const float reach = std::exp2(random.uniform(-10.0F, 20.0F));
    const float size = std::exp2(random.uniform(-5.0F, 5.0F));
    const auto base = (random.uniform_vec3<float>() - 0.5F) * reach;
    const glint::Cone<float> cone{.base = base,
                                  .top = base + (random.uniform_vec3<float>() - 0.5F) * size,
                                  .base_radius = size * random.uniform<float>(),
                                  .top_radius = size * random.uniform<float>()};
    if (glm::length(cone.top - cone.base) < size * 0.1F) continue;
    const auto rough = base + (random.uniform_vec3<float>() - 0.5F) * size;
    const auto part = static_cast<float>(i % 3);
    for (const auto& at : {surface(cone, rough, glint::Hit<float>{.uv = {part, 0}}),
                           sample_area(cone, random.uniform_vec2<float>()).surface}) {
      // the distance to the solid's boundary bounds the error along the normal; across it the point is free
      const double off = std::abs(solid(cone, Vec3d(at.position)));
      REQUIRE(off <= double(glm::dot(glint::abs(at.normal), at.position_error)) * 1.01);
    }
  }
}

TEMPLATE_TEST_CASE("cone: rays that leave it do not meet the place they left", "[geometry][cone]", float, double) {
  using T = TestType;
  for (const auto& cone : cones<T>()) {
    if (cone.ends == glint::Ends::Open) continue;
    const auto count = glint::testing::count_wrong_departures<T>(
        cone, [&](const glint::Vec2<T>& u) { return sample_area(cone, u).surface; });
    CHECK(count == 0);
  }
}

TEMPLATE_TEST_CASE("cone: uv and tangent follow angle and height", "[geometry][cone]", float, double) {
  using T = TestType;
  const glint::Cone<T> cone{
      .base = {1, 0, 0}, .top = {1, 0, 4}, .base_radius = 2, .top_radius = 1};  // frame: the world's
  const auto side = surface(cone, glint::Vec3<T>(1, T(1.5), 2), glint::Hit<T>{});
  CHECK(side.uv.x == Approx(0.25));
  CHECK(side.uv.y == T(0.5));
  CHECK(side.tangent.x == Approx(-2 * glint::pi<double> * 1.5));
  CHECK(side.normal.y == Approx(4 / std::sqrt(17.0)));  // across (0, −1, 4), the generator there
  CHECK(side.normal.z == Approx(1 / std::sqrt(17.0)));
  const auto base = surface(cone, glint::Vec3<T>(0, 0, 0), glint::Hit<T>{.uv = {1, 0}});
  CHECK(base.uv.x == T(0.5));
  CHECK(base.uv.y == Approx(0.5));
  CHECK(base.normal == glint::Vec3<T>(0, 0, -1));
  const auto top = surface(cone, glint::Vec3<T>(T(1.5), 0, 4), glint::Hit<T>{.uv = {2, 0}});
  CHECK(top.uv == glint::Vec2<T>(T(0.5), 0));
  CHECK(top.normal == glint::Vec3<T>(0, 0, 1));
}

TEMPLATE_TEST_CASE("cone: obeys the laws of Primitive, in tight bounds", "[geometry][cone][laws]", float, double) {
  const auto seed = GENERATE(range(0U, 8U));
  CAPTURE(seed);
  for (const auto& cone : cones<TestType>()) {
    CAPTURE(cone.base.x, cone.base_radius, cone.top_radius);
    CHECK(glint::testing::violations_of_primitive_laws(cone, seed) == std::vector<std::string>{});
    if (seed == 0) CHECK(glint::testing::violations_of_tight_bounds(cone, seed) == std::vector<std::string>{});
  }
}

TEMPLATE_TEST_CASE("cone: no point of it is closer than its closest point", "[geometry][cone]", float, double) {
  using T = TestType;
  glint::Cone<T> shape{.base = {T(0.5), 0, -1}, .top = {0, 1, T(0.25)}, .base_radius = 1, .top_radius = T(0.25)};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
  shape.ends = glint::Ends::Open;
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_cone

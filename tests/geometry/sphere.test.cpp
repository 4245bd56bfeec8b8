// SPDX-License-Identifier: MIT
#include <glint/geometry/sphere.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_sphere {

static_assert(glint::ShadablePrimitive<glint::Sphere<float>> && glint::SampleablePrimitive<glint::Sphere<double>>);

TEMPLATE_TEST_CASE("sphere: an axial ray enters one radius before the center", "[geometry][sphere]", float, double) {
  const glint::Sphere<TestType> sphere{.center = {0, 0, 5}, .radius = 2};
  const auto hit = intersect(glint::Ray<TestType>{.direction = {0, 0, 2}}, sphere);
  REQUIRE(hit);
  CHECK(hit->t == TestType(1.5));  // exact: (5 − 2) / |direction|, every operand representable
}

TEMPLATE_TEST_CASE("sphere: a ray from inside finds the far side", "[geometry][sphere]", float, double) {
  const glint::Sphere<TestType> sphere{.center = {1, 0, 0}, .radius = 2};
  const auto hit = intersect(glint::Ray<TestType>{.direction = {1, 0, 0}}, sphere);
  REQUIRE(hit);
  CHECK(hit->t == TestType(3));
  const auto from_center = intersect(glint::Ray<TestType>{.origin = {1, 0, 0}, .direction = {0, 4, 0}}, sphere);
  REQUIRE(from_center);
  CHECK(from_center->t == TestType(0.5));
}

TEMPLATE_TEST_CASE("sphere: a ray that only touches hits, one an ulp further out does not", "[geometry][sphere]", float,
                   double) {
  using T = TestType;
  const glint::Sphere<T> sphere{.center = {0, 0, 4}};
  const auto touching = intersect(glint::Ray<T>{.origin = {1, 0, 0}, .direction = {0, 0, 1}}, sphere);
  REQUIRE(touching);
  CHECK(touching->t == T(4));
  const T beyond = T(1) + std::numeric_limits<T>::epsilon();
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {beyond, 0, 0}, .direction = {0, 0, 1}}, sphere));
  const auto from_the_touching_point = intersect(glint::Ray<T>{.origin = {1, 0, 4}, .direction = {0, 0, 1}}, sphere);
  REQUIRE(from_the_touching_point);
  CHECK(from_the_touching_point->t == T(0));
}

TEMPLATE_TEST_CASE("sphere: both ends of the interval are included", "[geometry][sphere]", float, double) {
  const glint::Sphere<TestType> sphere{.center = {0, 0, 4}};  // crossed at 3 and 5
  const auto t = [&](TestType t_min, TestType t_max) {
    const auto hit = intersect(glint::Ray<TestType>{.direction = {0, 0, 1}, .t_min = t_min, .t_max = t_max}, sphere);
    return hit ? hit->t : TestType(-1);
  };
  CHECK(t(3, 3) == TestType(3));
  CHECK(t(5, 5) == TestType(5));
  CHECK(t(TestType(3.5), 5) == TestType(5));
  CHECK(t(TestType(3.5), TestType(4.5)) == TestType(-1));
  CHECK(t(6, 9) == TestType(-1));
}

TEST_CASE("sphere: small and far away, t in single precision agrees with extended precision", "[geometry][sphere]") {
  // b² − ac in float has no correct digit here: its terms are 10⁸ and it should be 10⁻².
  glint::Random random(2);
  const glint::Sphere<float> sphere{.center = {1e4F, 2e3F, -3e3F}, .radius = 0.1F};
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto offset = (random.uniform_vec3<float>() - 0.5F) * 0.1F;  // within 0.087 of the center: always a hit
    const glint::Ray<float> ray{.direction = sphere.center + offset};
    const glint::Sphere<long double> exact_sphere{glint::Vec3<long double>(sphere.center), sphere.radius};
    const glint::Ray<long double> exact_ray{.direction = glint::Vec3<long double>(ray.direction)};
    const auto exact = intersect(exact_ray, exact_sphere);
    const auto hit = intersect(ray, sphere);
    REQUIRE(exact.has_value() == hit.has_value());
    if (!hit) continue;
    ++hits;
    CHECK(std::abs(hit->t - exact->t) <= 4 * std::numeric_limits<float>::epsilon());
  }
  CHECK(hits > 900);
}

TEST_CASE("sphere: so large that it is a floor, t in single precision agrees with extended precision",
          "[geometry][sphere]") {
  glint::Random random(3);
  const glint::Sphere<float> floor{.center = {0, -1e6F, 0}, .radius = 1e6F};
  for (int i = 0; i < 1000; ++i) {
    const glint::Ray<float> ray{.origin = {0, 8, 0},
                                .direction = {random.uniform<float>(), -1.0F, random.uniform<float>()}};
    const auto exact =
        intersect(glint::Ray<double>{.origin = {0, 8, 0}, .direction = glint::Vec3<double>(ray.direction)},
                  glint::Sphere<double>{.center = {0, -1e6, 0}, .radius = 1e6});
    const auto hit = intersect(ray, floor);
    REQUIRE(hit);
    REQUIRE(exact);
    CHECK(std::abs(double(hit->t) - exact->t) < 0.25);  // four roundings of 10⁶, the scale of the operands
  }
}

TEMPLATE_TEST_CASE("sphere: is not hit where it has no size, or a NaN", "[geometry][sphere]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Ray<T> ray{.origin = {0, 0, 2}};
  CHECK_FALSE(intersect(ray, glint::Sphere<T>{.radius = 0}));
  CHECK_FALSE(intersect(ray, glint::Sphere<T>{.radius = nan}));
  CHECK_FALSE(intersect(ray, glint::Sphere<T>{.center = {nan, 0, 0}}));
  CHECK_FALSE(intersect(ray, glint::Sphere<T>{.center = {std::numeric_limits<T>::max(), 0, 0}}));
}

TEMPLATE_TEST_CASE("sphere: uv is (θ/π, φ/2π), θ from +z and φ from +x toward +y", "[geometry][sphere]", float,
                   double) {
  using T = TestType;
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = 2};
  const auto uv = [&](const glint::Vec3<T>& direction) {
    return surface(sphere, sphere.center + direction * sphere.radius).uv;
  };
  const T rounding = 4 * std::numeric_limits<T>::epsilon();
  const auto near = [&](const glint::Vec2<T>& a, const glint::Vec2<T>& b) {
    return std::abs(a.x - b.x) <= rounding && std::abs(a.y - b.y) <= rounding;
  };
  CHECK(near(uv({1, 0, 0}), {T(0.5), T(0)}));
  CHECK(near(uv({0, 1, 0}), {T(0.5), T(0.25)}));
  CHECK(near(uv({-1, 0, 0}), {T(0.5), T(0.5)}));
  CHECK(near(uv({0, -1, 0}), {T(0.5), T(0.75)}));
  CHECK(uv({0, 0, 1}).x == T(0));
  CHECK(near(uv({0, 0, -1}), {T(1), T(0)}));
  CHECK(surface(glint::Sphere<T>{}, glint::Vec3<T>(1, -std::numeric_limits<T>::min(), 0)).uv.y < T(1));
}

TEMPLATE_TEST_CASE("sphere: the tangent is the derivative of the position by u", "[geometry][sphere]", float, double) {
  using T = TestType;
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = 2};
  glint::Random random(4);
  for (int i = 0; i < 100; ++i) {
    const auto u = random.template uniform_vec2<T>();
    const auto at = sample_area(sphere, u).surface;
    const auto point = [&](double theta, double phi) {
      return glint::Vec3<double>(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)) *
             2.0;
    };
    const double theta = double(at.uv.x) * glint::pi<double>;
    const double phi = double(at.uv.y) * 2 * glint::pi<double>;
    const double h = 1e-4;
    const auto slope =
        (point(theta + h, phi) - point(theta - h, phi)) * (glint::pi<double> / (2 * h));  // central: error O(h²)
    CHECK(glint::max_component(glint::abs(glint::Vec3<double>(at.tangent) - slope)) < 1e-4);
  }
}

TEMPLATE_TEST_CASE("sphere: a position in the center, or at a pole, has finite shading data", "[geometry][sphere]",
                   float, double) {
  using T = TestType;
  for (const glint::Vec3<T>& position : {glint::Vec3<T>(0, 0, 0), glint::Vec3<T>(0, 0, 1), glint::Vec3<T>(0, 0, -1)}) {
    const auto at = surface(glint::Sphere<T>{}, position);
    CHECK(glm::length(at.normal) == T(1));
    CHECK(glint::is_finite(at.position));
    CHECK(glm::length(at.tangent) > T(3));  // π · radius
    CHECK(glm::dot(at.tangent, at.normal) == T(0));
  }
}

TEST_CASE("sphere: the error bound holds in single precision, wherever the sphere is", "[geometry][sphere]") {
  glint::Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const float reach = std::exp2(random.uniform(-20.0F, 20.0F));
    const glint::Sphere<float> sphere{.center = (random.uniform_vec3<float>() - 0.5F) * reach,
                                      .radius = std::exp2(random.uniform(-10.0F, 10.0F))};
    const auto rough = sphere.center + (random.uniform_vec3<float>() - 0.5F) * (4 * sphere.radius);
    if (rough == sphere.center) continue;  // where it is tiny and far away
    const auto at = surface(sphere, rough);
    const auto outward = glint::Vec3<double>(rough - sphere.center);  // any direction will do: the same as the header's
    const auto exact = glint::Vec3<double>(sphere.center) + glm::normalize(outward) * double(sphere.radius);
    const auto off = glint::abs(exact - glint::Vec3<double>(at.position));
    REQUIRE(off.x <= double(at.position_error.x));
    REQUIRE(off.y <= double(at.position_error.y));
    REQUIRE(off.z <= double(at.position_error.z));
  }
}

TEMPLATE_TEST_CASE("sphere: samples are uniform by area: heights and longitudes are", "[geometry][sphere]", float,
                   double) {
  using T = TestType;
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = T(0.5)};
  CHECK(area(sphere) == Approx(glint::pi<double>));
  constexpr int cells = 8;
  constexpr int samples = 6400;
  int counts[cells][cells] = {};
  glint::Random random(6);
  for (int i = 0; i < samples; ++i) {
    const auto sample = sample_area(sphere, random.template uniform_vec2<T>());
    const auto local = sample.surface.normal;
    const double turns = std::atan2(double(local.y), double(local.x)) / (2 * glint::pi<double>)+0.5;
    const int row = std::min(int((double(local.z) + 1) / 2 * cells), cells - 1);
    ++counts[row][std::min(int(turns * cells), cells - 1)];
    CHECK(sample.pdf == Approx(1 / glint::pi<double>));
  }
  double chi_square = 0;
  for (const auto& row : counts) {
    for (const int count : row) chi_square += (count - 100.0) * (count - 100.0) / 100.0;  // 6400 / 64 in each
  }
  CHECK(chi_square < 137.0);  // 63 degrees of freedom: exceeded less than once in 10⁷ seeds
}

TEMPLATE_TEST_CASE("sphere: a sample's surface is the one that its position has", "[geometry][sphere]", float, double) {
  using T = TestType;
  const glint::Sphere<T> sphere{.center = {1, 2, 3}, .radius = T(0.5)};
  glint::Random random(8);
  for (int i = 0; i < 200; ++i) {
    const auto sample = sample_area(sphere, random.template uniform_vec2<T>()).surface;
    const auto same = surface(sphere, sample.position);
    const T rounding = T(256) * std::numeric_limits<T>::epsilon();  // of a position at 3 and a radius of 0.5, times π
    CHECK(glm::length(same.position - sample.position) <= rounding);
    CHECK(glm::length(same.normal - sample.normal) <= rounding);
    CHECK(std::abs(same.uv.x - sample.uv.x) <= rounding);
  }
}

TEMPLATE_TEST_CASE("sphere: obeys the laws of Primitive", "[geometry][sphere][laws]", float, double) {
  using T = TestType;
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  const auto unit = glint::testing::violations_of_primitive_laws(glint::Sphere<T>{.radius = T(0.7)}, seed);
  CHECK(unit == std::vector<std::string>{});
  const glint::Sphere<T> off_center{.center = {-30, 10, 20}, .radius = T(3)};
  CHECK(glint::testing::violations_of_primitive_laws(off_center, seed) == std::vector<std::string>{});
  const glint::Sphere<T> small{.center = {T(1e-6), 0, 0}, .radius = T(1e-6)};
  CHECK(glint::testing::violations_of_primitive_laws(small, seed) == std::vector<std::string>{});
  const glint::Sphere<T> large{.center = {T(1e6), 0, 0}, .radius = T(2e6)};
  CHECK(glint::testing::violations_of_primitive_laws(large, seed) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("sphere: no point of it is closer than its closest point", "[geometry][sphere]", float, double) {
  using T = TestType;
  const glint::Sphere<T> shape{.center = {T(0.5), 0, T(-0.25)}, .radius = 1};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
  CHECK(closest_point(shape.center, shape) == shape.center + glint::Vec3<T>(1, 0, 0));
}

}  // namespace test_geometry_sphere

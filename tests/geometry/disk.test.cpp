// SPDX-License-Identifier: MIT
#include <glint/geometry/disk.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_disk {

static_assert(glint::ShadablePrimitive<glint::Disk<float>> && glint::SampleablePrimitive<glint::Disk<double>>);

TEMPLATE_TEST_CASE("disk: is hit from both sides, whatever the length of its normal", "[geometry][disk]", float,
                   double) {
  using T = TestType;
  const glint::Disk<T> disk{.center = {0, 0, 4}, .normal = {0, 0, -8}, .radius = 2};
  const auto front = intersect(glint::Ray<T>{.origin = {1, 1, 0}, .direction = {0, 0, 2}}, disk);
  REQUIRE(front);
  CHECK(front->t == T(2));
  const auto back = intersect(glint::Ray<T>{.origin = {1, 1, 5}, .direction = {0, 0, -1}}, disk);
  REQUIRE(back);
  CHECK(back->t == T(1));
}

TEMPLATE_TEST_CASE("disk: its rim is part of it, an ulp further is not", "[geometry][disk]", float, double) {
  using T = TestType;
  const auto is_hit = [](T x, T y) {
    return intersect(glint::Ray<T>{.origin = {x, y, 1}}, glint::Disk<T>{.radius = 5}).has_value();
  };
  CHECK(is_hit(5, 0));
  CHECK(is_hit(3, -4));
  CHECK_FALSE(is_hit(std::nextafter(T(5), T(6)), 0));
  CHECK_FALSE(is_hit(4, 4));
}

TEMPLATE_TEST_CASE("disk: is not hit along its plane, without size or normal, or with a NaN", "[geometry][disk]", float,
                   double) {
  using T = TestType;
  using D = glint::Disk<T>;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {-2, 0, 0}, .direction = {1, 0, 0}}, D{}));
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {-2, 0, 1}, .direction = {1, 0, 0}}, D{}));
  const glint::Ray<T> ray{.origin = {0, 0, 1}};
  REQUIRE(intersect(ray, D{}));
  CHECK_FALSE(intersect(ray, D{.radius = 0}));
  CHECK_FALSE(intersect(ray, D{.radius = nan}));
  CHECK_FALSE(intersect(ray, D{.normal = {0, 0, 0}}));
  CHECK_FALSE(intersect(ray, D{.normal = {nan, 0, 1}}));
  CHECK_FALSE(intersect(ray, D{.center = {0, nan, 0}}));
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {0, 0, 1}, .direction = {0, 0, -glint::infinity<T>}}, D{}));
}

TEMPLATE_TEST_CASE("disk: its box touches the rim on all sides", "[geometry][disk]", float, double) {
  using T = TestType;
  CHECK(bounds(glint::Disk<T>{.center = {1, 2, 3}, .normal = {0, -4, 0}, .radius = 2}) ==
        glint::Aabb<T>{{-1, 2, 1}, {3, 2, 5}});  // flat along y
  const glint::Disk<T> disk{.center = {1, 2, 3}, .normal = {1, 2, -2}, .radius = 2};
  const auto frame = glint::Frame<T>::around(glm::normalize(disk.normal));
  glint::Aabb<T> rim;  // the oracle: many points of the rim; between them the circle bulges by r (Δφ)² / 8
  for (int i = 0; i < 4096; ++i) {
    const T phi = T(i) * 2 * glint::pi<T> / 4096;
    extend(rim, disk.center + (frame.x * std::cos(phi) + frame.y * std::sin(phi)) * disk.radius);
  }
  const auto box = bounds(disk);
  CHECK(glint::max_component(glint::abs(box.lower - rim.lower)) <= T(2e-6));
  CHECK(glint::max_component(glint::abs(box.upper - rim.upper)) <= T(2e-6));
}

TEMPLATE_TEST_CASE("disk: uv is the fraction of the radius and of the turn about the normal", "[geometry][disk]", float,
                   double) {
  using T = TestType;
  const glint::Disk<T> disk{.center = {1, 0, 0}, .normal = {0, 0, 3}, .radius = 2};  // its frame: x and y of the world
  const auto at = surface(disk, glint::Vec3<T>(1, -1, 0));
  CHECK(at.uv.x == T(0.5));
  CHECK(at.uv.y == Approx(0.75));
  CHECK(at.normal == glint::Vec3<T>(0, 0, 1));
  CHECK(at.tangent == glint::Vec3<T>(0, -2, 0));  // one radius outward
  CHECK(at.position_error.z > T(0));
  const auto center = surface(disk, disk.center);
  CHECK(center.uv == glint::Vec2<T>(0, 0));
  CHECK(center.tangent == glint::Vec3<T>(2, 0, 0));
}

TEMPLATE_TEST_CASE("disk: a position off the disk is brought back onto it", "[geometry][disk]", float, double) {
  using T = TestType;
  const glint::Disk<T> disk{.normal = {0, 0, 1}, .radius = 2};
  const auto at = surface(disk, glint::Vec3<T>(4, 0, 1));
  CHECK(at.position == glint::Vec3<T>(2, 0, 0));
  CHECK(at.uv.x == T(1));
}

TEST_CASE("disk: the error bound holds in single precision, wherever the disk is", "[geometry][disk]") {
  using Vec3d = glint::Vec3<double>;
  glint::Random random(9);
  for (int i = 0; i < 20000; ++i) {
    const float reach = std::exp2(random.uniform(-20.0F, 20.0F));
    const glint::Disk<float> disk{.center = (random.uniform_vec3<float>() - 0.5F) * reach,
                                  .normal = random.uniform_vec3<float>() - 0.5F,
                                  .radius = std::exp2(random.uniform(-10.0F, 10.0F))};
    const auto rough = disk.center + (random.uniform_vec3<float>() - 0.5F) * (3 * disk.radius);
    for (const auto& at : {surface(disk, rough), sample_area(disk, random.uniform_vec2<float>()).surface}) {
      // the oracle: the nearest point of the true disk, in double precision
      const Vec3d normal = glm::normalize(Vec3d(disk.normal));
      const Vec3d local = Vec3d(at.position) - Vec3d(disk.center);
      Vec3d nearest = local - normal * glm::dot(normal, local);
      nearest *= std::min(1.0, double(disk.radius) / glm::length(nearest));
      const auto off = glint::abs(nearest - local);
      REQUIRE(off.x <= double(at.position_error.x));
      REQUIRE(off.y <= double(at.position_error.y));
      REQUIRE(off.z <= double(at.position_error.z));
    }
  }
}

TEMPLATE_TEST_CASE("disk: samples are uniform by area: squared distances and angles are", "[geometry][disk]", float,
                   double) {
  using T = TestType;
  const glint::Disk<T> disk{.center = {1, 0, 0}, .normal = {0, 0, 3}, .radius = 2};
  constexpr int cells = 8;
  int counts[cells][cells] = {};
  glint::Random random(6);
  for (int i = 0; i < 6400; ++i) {
    const auto sample = sample_area(disk, random.template uniform_vec2<T>());
    const auto local = glint::Vec3<double>(sample.surface.position - disk.center);
    const double turns = std::atan2(local.y, local.x) / (2 * glint::pi<double>)+0.5;
    const int ring = std::min(int((local.x * local.x + local.y * local.y) / 4 * cells), cells - 1);
    ++counts[ring][std::min(int(turns * cells), cells - 1)];
    CHECK(sample.pdf == Approx(1 / (4 * glint::pi<double>)));
  }
  double chi_square = 0;
  for (const auto& ring : counts) {
    for (const int count : ring) chi_square += (count - 100.0) * (count - 100.0) / 100.0;  // 6400 / 64 in each
  }
  CHECK(chi_square < 137.0);  // 63 degrees of freedom: exceeded less than once in 10⁷ seeds
}

TEMPLATE_TEST_CASE("disk: a sample's surface is the one that its position has", "[geometry][disk]", float, double) {
  using T = TestType;
  const glint::Disk<T> disk{.center = {1, 0, 2}, .normal = {1, 2, 3}, .radius = 2};
  glint::Random random(6);
  for (int i = 0; i < 200; ++i) {
    const auto sample = sample_area(disk, random.template uniform_vec2<T>()).surface;
    const auto same = surface(disk, sample.position);
    const T rounding = T(64) * std::numeric_limits<T>::epsilon();
    CHECK(glm::length(same.position - sample.position) <= rounding);
    CHECK(same.normal == sample.normal);
    CHECK(std::abs(same.uv.x - sample.uv.x) <= rounding);
    CHECK(std::abs(same.uv.y - sample.uv.y) * sample.uv.x <= rounding);
    CHECK(glm::length(same.tangent - sample.tangent) * sample.uv.x <= T(4) * rounding);
  }
}

TEMPLATE_TEST_CASE("disk: obeys the laws of Primitive", "[geometry][disk][laws]", float, double) {
  using T = TestType;
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  CHECK(glint::testing::violations_of_primitive_laws(glint::Disk<T>{}, seed) == std::vector<std::string>{});
  const glint::Disk<T> slanted{.center = {3, -2, 1}, .normal = {1, 2, T(-0.5)}, .radius = T(0.4)};
  CHECK(glint::testing::violations_of_primitive_laws(slanted, seed) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("disk: no point of it is closer than its closest point", "[geometry][disk]", float, double) {
  using T = TestType;
  const glint::Disk<T> shape{.center = {T(0.5), 0, 0}, .normal = {1, 2, -2}, .radius = 1};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_disk

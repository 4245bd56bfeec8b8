// SPDX-License-Identifier: MIT
#include <glint/geometry/box.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <limits>

#include <support/catch.hpp>
#include <support/closest_points.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_box {

static_assert(glint::ShadablePrimitive<glint::Box<float>> && glint::SampleablePrimitive<glint::Box<double>>);

TEMPLATE_TEST_CASE("box: each face is hit from outside and from inside, and faces outward", "[geometry][box]", float,
                   double) {
  using T = TestType;
  const glint::Box<T> box{{1, 2, 3}, {3, 4, 5}};  // its center: (2, 3, 4), half a side: 1
  const glint::Vec3<T> center(2, 3, 4);
  for (int face = 0; face < 6; ++face) {
    CAPTURE(face);
    const T sign = face % 2 == 0 ? T(-1) : T(1);
    const glint::Vec3<T> out{face / 2 == 0 ? sign : T(0), face / 2 == 1 ? sign : T(0), face / 2 == 2 ? sign : T(0)};
    const auto outside = intersect(glint::Ray<T>{.origin = center + out * T(3), .direction = -out}, box);
    const auto inside = intersect(glint::Ray<T>{.origin = center, .direction = out * T(2)}, box);
    REQUIRE(outside);
    REQUIRE(inside);
    CHECK(outside->t == T(2));
    CHECK(inside->t == T(0.5));
    CHECK(inside->uv == outside->uv);
    const auto at = surface(box, center + out, *outside);
    CHECK(at.normal == out);
    CHECK(at.position == center + out);
    CHECK(at.uv == glint::Vec2<T>(T(0.5), T(0.5)));
  }
}

TEMPLATE_TEST_CASE("box: uv and tangent follow the next two axes", "[geometry][box]", float, double) {
  using T = TestType;
  const glint::Box<T> box{{0, 0, 0}, {2, 4, 8}};
  const auto at = [&](int face, const glint::Vec3<T>& p) {
    return surface(box, p, glint::Hit<T>{.uv = {T(face), T(0)}});
  };
  CHECK(at(1, {2, 1, 6}).uv == glint::Vec2<T>(T(0.25), T(0.75)));
  CHECK(at(1, {2, 1, 6}).tangent == glint::Vec3<T>(0, 4, 0));
  CHECK(at(2, {1, 0, 6}).uv == glint::Vec2<T>(T(0.75), T(0.5)));
  CHECK(at(2, {1, 0, 6}).tangent == glint::Vec3<T>(0, 0, 8));
  CHECK(at(5, {1, 3, 8}).uv == glint::Vec2<T>(T(0.5), T(0.75)));
  CHECK(at(5, {1, 3, 8}).tangent == glint::Vec3<T>(2, 0, 0));
}

TEMPLATE_TEST_CASE("box: a ray that runs in a face meets the faces at its ends", "[geometry][box]", float, double) {
  using T = TestType;
  for (const T x : {T(0), T(1)}) {
    for (const T zero : {T(0), T(-0.0)}) {
      const auto hit =
          intersect(glint::Ray<T>{.origin = {x, T(0.5), 3}, .direction = {zero, zero, -1}}, glint::Box<T>{});
      REQUIRE(hit);
      CHECK(*hit == glint::Hit<T>{.t = 2, .uv = {T(5), T(0)}});
    }
  }
  const T beside = std::nextafter(T(1), T(2));
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {beside, T(0.5), 3}}, glint::Box<T>{}));
}

TEMPLATE_TEST_CASE("box: directions too small to have a reciprocal hit all the same", "[geometry][box]", float,
                   double) {
  using T = TestType;
  const T tiny = std::numeric_limits<T>::denorm_min() * 4;
  const auto hit = intersect(glint::Ray<T>{.origin = {T(0), T(0.5), 3}, .direction = {tiny, 0, -1}}, glint::Box<T>{});
  REQUIRE(hit);
  CHECK(hit->t == T(2));
}

TEMPLATE_TEST_CASE("box: is not hit where it is empty, or has a NaN", "[geometry][box]", float, double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const glint::Ray<T> ray{.origin = {T(0.5), T(0.5), 2}, .direction = {T(0.1), T(0.1), -1}};
  REQUIRE(intersect(ray, glint::Box<T>{}));
  CHECK_FALSE(intersect(ray, glint::Box<T>{{0, 0, 1}, {1, 1, 0}}));
  CHECK_FALSE(intersect(ray, glint::Box<T>{{1, 0, 0}, {0, 1, 1}}));
  CHECK_FALSE(intersect(ray, glint::Box<T>{{nan, 0, 0}, {1, 1, 1}}));
  CHECK_FALSE(intersect(ray, glint::Box<T>{{0, 0, 0}, {1, nan, 1}}));
  const T inf = glint::infinity<T>;
  CHECK_FALSE(intersect(glint::Ray<T>{}, glint::Box<T>{{-inf, -inf, -inf}, {inf, inf, inf}}));
}

TEMPLATE_TEST_CASE("box: agrees with its six sides taken one by one", "[geometry][box]", float, double) {
  using T = TestType;
  const glint::Box<T> box{{-1, T(-0.5), T(-0.25)}, {1, T(0.75), T(0.5)}};
  glint::Random random(12);
  int hits = 0;
  for (int i = 0; i < 5000; ++i) {
    const glint::Ray<T> ray{random.template uniform_vec3<T>() * T(4) - T(2),
                            random.template uniform_vec3<T>() * T(2) - T(1)};
    T nearest = glint::infinity<T>;  // the oracle: all six planes, each point checked on the other two axes
    for (int axis = 0; axis < 3; ++axis) {
      for (const auto& corner : {box.lower, box.upper}) {
        const T t = (glint::component(corner, axis) - glint::component(ray.origin, axis)) /
                    glint::component(ray.direction, axis);
        const auto p = ray.at(t);
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        const bool on_face = glint::component(p, u) >= glint::component(box.lower, u) &&
                             glint::component(p, u) <= glint::component(box.upper, u) &&
                             glint::component(p, v) >= glint::component(box.lower, v) &&
                             glint::component(p, v) <= glint::component(box.upper, v);
        if (on_face && t >= T(0) && t < nearest) nearest = t;
      }
    }
    const auto hit = intersect(ray, box);
    REQUIRE(hit.has_value() == (nearest < glint::infinity<T>));
    if (!hit) continue;
    ++hits;
    REQUIRE(hit->t == nearest);
  }
  CHECK(hits > 500);
}

TEMPLATE_TEST_CASE("box: samples fall on faces in proportion to their area, uniform on each", "[geometry][box]", float,
                   double) {
  using T = TestType;
  const glint::Box<T> box{{0, 0, 0}, {1, 2, 4}};
  CHECK(area(box) == T(28));  // 2 (1·2 + 2·4 + 4·1)
  CHECK(bounds(box) == glint::Aabb<T>{{0, 0, 0}, {1, 2, 4}});
  std::array<std::array<double, 4>, 6> counts{};  // quarters of faces
  glint::Random random(13);
  constexpr int samples = 14000;
  for (int i = 0; i < samples; ++i) {
    const auto sample = sample_area(box, random.template uniform_vec2<T>());
    const auto& at = sample.surface;
    CHECK(sample.pdf == Approx(1.0 / 28));
    const int axis = at.normal.x != 0 ? 0 : at.normal.y != 0 ? 1 : 2;
    const bool is_upper = glint::component(at.normal, axis) > T(0);
    CHECK(glint::component(at.position, axis) == glint::component(is_upper ? box.upper : box.lower, axis));
    const auto face = static_cast<std::size_t>(2 * axis + (is_upper ? 1 : 0));
    ++counts[face][(at.uv.x < T(0.5) ? 0U : 1U) + (at.uv.y < T(0.5) ? 0U : 2U)];
  }
  const std::array<double, 3> face_area{8, 4, 2};
  double chi_square = 0;
  for (std::size_t face = 0; face < 6; ++face) {
    const double expected = samples * face_area[face / 2] / 28 / 4;
    for (const double count : counts[face]) chi_square += (count - expected) * (count - expected) / expected;
  }
  CHECK(chi_square < 72.0);  // 23 degrees of freedom: exceeded less than once in 10⁶ seeds
}

TEMPLATE_TEST_CASE("box: obeys the laws of Primitive", "[geometry][box][laws]", float, double) {
  using T = TestType;
  const auto seed = GENERATE(range(0U, 20U));
  CAPTURE(seed);
  CHECK(glint::testing::violations_of_primitive_laws(glint::Box<T>{}, seed) == std::vector<std::string>{});
  const glint::Box<T> off_center{{T(-3.3), 7, 20}, {T(-3.1), 9, 21}};
  CHECK(glint::testing::violations_of_primitive_laws(off_center, seed) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("box: no point of it is closer than its closest point", "[geometry][box]", float, double) {
  using T = TestType;
  const glint::Box<T> shape{.lower = {-1, T(-1.5), 0}, .upper = {1, T(0.5), 1}};
  CHECK(glint::testing::violations_of_closest_points(shape).empty());
}

}  // namespace test_geometry_box

// SPDX-License-Identifier: MIT
#include <glint/geometry/offset.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <span>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>

#include <support/catch.hpp>

namespace test_geometry_offset {

namespace {

using glint::Ray;
using glint::SurfaceOf;
using glint::Vec3;

template <typename T>
struct Random {
  std::mt19937 engine;
  std::uniform_real_distribution<T> uniform{T(-1), T(1)};

  T operator()() { return uniform(engine); }
  Vec3<T> vector() {
    const T x = uniform(engine);
    const T y = uniform(engine);
    const T z = uniform(engine);
    return {x, y, z};
  }
  /// Directions at all angles to the normal, down to a billionth of a right angle.
  Vec3<T> direction_off(const Vec3<T>& normal) {
    const Vec3<T> along = glm::normalize(vector() - normal * glm::dot(vector(), normal));
    const T lift = std::pow(T(10), T(-4.5) + T(4.5) * (*this)());
    return along + normal * (engine() % 2 == 0 ? lift : -lift);
  }
};

/// The first hit of a primitive and its surface there, the way a scene finds them.
template <typename T, typename P>
std::optional<SurfaceOf<T>> found_by(const Ray<T>& ray, const P& primitive) {
  const glint::Elements set{std::span(&primitive, 1)};
  const auto hit = set.intersect(ray, 0);
  if (!hit) return std::nullopt;
  return set.surface(ray, *hit);
}

}  // namespace

TEMPLATE_TEST_CASE("offset: moves out to the side that the direction points to, beyond the error", "[geometry][offset]",
                   float, double) {
  using T = TestType;
  Random<T> random{std::mt19937(1)};
  int inside = 0;
  int far = 0;
  for (int i = 0; i < 20000; ++i) {
    const T scale = std::pow(T(10), T(6) * random());
    SurfaceOf<T> at;
    at.normal = glm::normalize(random.vector());
    at.position = random.vector() * scale * (i % 2 == 0 ? T(1) : T(1e4));
    at.position_error = glint::abs(random.vector()) * scale * T(1e-5);
    const Vec3<T> direction = random.direction_off(at.normal);
    const Vec3<T> moved = offset_origin(at, direction);
    // How far, in exact arithmetic, the result is on its side of the position; the error box reaches |n| · error.
    using Exact = glm::vec<3, long double, glm::packed_highp>;
    const Exact n = Exact(at.normal) * (glm::dot(direction, at.normal) < T(0) ? -1.0L : 1.0L);
    const long double height = glm::dot(n, Exact(moved) - Exact(at.position));
    const long double reach = glm::dot(Exact(abs(at.normal)), Exact(at.position_error));
    const long double last_places =
        glm::dot(Exact(abs(at.normal)), Exact(abs(at.position))) * (4 * std::numeric_limits<T>::epsilon());
    inside += height < reach ? 1 : 0;
    far += height > reach * 1.001L + last_places ? 1 : 0;
  }
  CHECK(inside == 0);
  CHECK(far == 0);
}

TEMPLATE_TEST_CASE("offset: rays that leave a triangle never meet it again, at any scale and place",
                   "[geometry][offset]", float, double) {
  using T = TestType;
  const T scale = GENERATE(T(1e-6), T(1e-3), T(1), T(1e3), T(1e6));
  const T away = GENERATE(T(0), T(1), T(1e2), T(1e4));
  CAPTURE(scale, away);
  Random<T> random{std::mt19937(2)};
  int starts = 0;
  int met_again = 0;
  int far = 0;
  int too_long = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3<T> center = random.vector() * (away * scale);
    const bool is_flat = i % 3 == 0;  // in a coordinate plane, where errors cancel or vanish
    const auto corner = [&] {
      Vec3<T> v = random.vector();
      if (is_flat) v.y = 0;
      return v * scale;
    };
    const Vec3<T> v0 = i % 6 == 0 ? Vec3<T>(T(0)) : center + corner();
    const glint::Triangle<T> triangle{v0, v0 + corner(), v0 + corner()};
    const Vec3<T> e1 = triangle.v1 - triangle.v0;
    const Vec3<T> e2 = triangle.v2 - triangle.v0;
    const Vec3<T> target = triangle.v0 + e1 * std::abs(random() * T(0.5)) + e2 * std::abs(random() * T(0.5));
    const Vec3<T> from = target + random.vector() * scale * T(3);
    const auto at = found_by(Ray<T>{from, target - from}, triangle);
    if (!at) continue;
    ++starts;
    const Ray<T> ray = spawn_ray(*at, random.direction_off(at->normal));
    met_again += intersect(ray, triangle) ? 1 : 0;
    const T reach =
        glm::dot(abs(at->normal), at->position_error + abs(at->position) * std::numeric_limits<T>::epsilon());
    far += glm::length(ray.origin - at->position) > T(2) * reach ? 1 : 0;
    // For a triangle at least half as thick as long: 10 ε of its size, 1.5 ε of its place, each times |n| ≤ √3 in all.
    const T thickness = glm::length(glm::cross(e1, e2)) / std::max(glm::dot(e1, e1), glm::dot(e2, e2));
    const T limit = T(32) * std::numeric_limits<T>::epsilon() * scale * (T(1) + away);
    too_long += thickness > T(0.5) && reach > limit ? 1 : 0;
  }
  CHECK(starts > 500);
  CHECK(met_again == 0);
  CHECK(far == 0);
  CHECK(too_long == 0);
}

TEMPLATE_TEST_CASE("offset: rays that leave a sphere outward never meet it again, at any scale and place",
                   "[geometry][offset]", float, double) {
  using T = TestType;
  const T scale = GENERATE(T(1e-6), T(1e-3), T(1), T(1e3), T(1e6));
  const T away = GENERATE(T(0), T(1), T(1e2), T(1e4));
  CAPTURE(scale, away);
  Random<T> random{std::mt19937(3)};
  int starts = 0;
  int met_again = 0;
  int tunneled = 0;
  for (int i = 0; i < 2000; ++i) {
    const glint::Sphere<T> sphere{.center = random.vector() * (away * scale), .radius = scale};
    const Vec3<T> from = sphere.center + random.vector() * scale * T(3);
    const auto at = found_by(Ray<T>{from, sphere.center + random.vector() * scale - from}, sphere);
    if (!at) continue;
    ++starts;
    const Vec3<T> direction = random.direction_off(at->normal);
    const bool is_outward = glm::dot(direction, at->normal) > T(0);
    const Ray<T> ray = spawn_ray(*at, direction);
    if (is_outward) met_again += intersect(ray, sphere) ? 1 : 0;
    // From the inside there is no way out but through the surface; rays that graze stay within the error.
    const bool is_steep = std::abs(glm::dot(direction, at->normal)) > T(0.1) * glm::length(direction);
    if (!is_outward && is_steep) tunneled += intersect(ray, sphere) ? 0 : 1;
  }
  CHECK(starts > 300);
  CHECK(met_again == 0);
  CHECK(tunneled == 0);
}

TEMPLATE_TEST_CASE("offset: neither end of a ray between two surfaces hides the other", "[geometry][offset]", float,
                   double) {
  using T = TestType;
  const T scale = GENERATE(T(1e-6), T(1), T(1e6));
  const T distance = GENERATE(T(0.01), T(1), T(1e4));
  CAPTURE(scale, distance);
  Random<T> random{std::mt19937(4)};
  int hidden = 0;
  int wrong_end = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto triangle_at = [&](const Vec3<T>& center) {
      return glint::Triangle<T>{center + random.vector() * scale, center + random.vector() * scale,
                                center + random.vector() * scale};
    };
    const Vec3<T> offset = glm::normalize(random.vector()) * (distance * scale);
    const auto here = triangle_at(Vec3<T>(T(0)));
    const auto there = triangle_at(offset);
    const SurfaceOf<T> from = surface_at(here, T(0.3), T(0.4));
    const SurfaceOf<T> to = surface_at(there, T(0.2), T(0.5));
    const Ray<T> ray = spawn_ray_to(from, to);
    hidden += intersect(ray, here) || intersect(ray, there) ? 1 : 0;
    const T rounding = T(64) * std::numeric_limits<T>::epsilon() * scale * (T(2) + distance);
    const T slack = T(2) * glm::length(to.position_error) + rounding;
    wrong_end += glm::length(ray.at(T(1)) - to.position) > slack ? 1 : 0;
    const Ray<T> to_point = spawn_ray_to(from, to.position);
    hidden += intersect(to_point, here) ? 1 : 0;
    wrong_end += glm::length(to_point.at(T(1)) - to.position) > slack ? 1 : 0;
  }
  CHECK(hidden == 0);
  CHECK(wrong_end == 0);
}

}  // namespace test_geometry_offset

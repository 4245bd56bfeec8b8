// SPDX-License-Identifier: MIT
#include <glint/geometry/elements.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include <glint/geometry/triangle.hpp>

#include <support/catch.hpp>

namespace test_geometry_elements {

namespace user {

/// A wall at a height, as somebody who knows nothing but the concept would write it.
struct Wall {
  double z = 0;
};

glint::Aabb<double> bounds(const Wall& wall) {
  const double far = std::numeric_limits<double>::max();
  return {{-far, -far, wall.z}, {far, far, wall.z}};
}

std::optional<glint::Hit<double>> intersect(const glint::Ray<double>& ray, const Wall& wall) {
  const double t = (wall.z - ray.origin.z) / ray.direction.z;
  if (!(t >= ray.t_min && t <= ray.t_max)) return std::nullopt;
  return glint::Hit<double>{.t = t};
}

glint::SurfaceOf<double> surface(const Wall&, const glint::Vec3<double>& position) {
  return {.position = position, .normal = {0, 0, 1}};
}

}  // namespace user

namespace {

static_assert(glint::ShadableSet<glint::Elements<user::Wall>>);
static_assert(glint::ShadableSet<glint::Elements<glint::Triangle<float>, std::uint64_t>>);

}  // namespace

TEST_CASE("elements: a vector, an array or a span of primitives is a set", "[geometry][elements]") {
  const std::vector<user::Wall> walls{{1}, {2}, {3}};
  std::array<user::Wall, 2> two{{{4}, {5}}};
  const glint::Elements set{walls};
  REQUIRE(set.size() == 3);
  CHECK(glint::Elements{two}.size() == 2);
  CHECK(glint::Elements{std::span(walls)}.size() == 3);
  CHECK(glint::Elements<user::Wall>().size() == 0);
  CHECK(set.bounds(2).lower.z == 3);
  CHECK(set[1].z == 2);
}

TEST_CASE("elements: hits carry the index, and misses stay misses", "[geometry][elements]") {
  const std::vector<user::Wall> walls{{1}, {2}, {3}};
  const glint::Elements<user::Wall, std::uint16_t> set{walls};
  const glint::Ray<double> ray{.direction = {0, 0, 1}, .t_max = 2};
  const auto hit = set.intersect(ray, 1);
  REQUIRE(hit);
  CHECK(*hit == glint::Hit<double, std::uint16_t>{.t = 2, .primitive = 1});
  CHECK_FALSE(set.intersect(ray, 2));
}

TEST_CASE("elements: a primitive that does not know its error gets one from the ray", "[geometry][elements]") {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> uniform(-1, 1);
  int outside = 0;
  for (int i = 0; i < 10000; ++i) {
    const std::array<user::Wall, 1> wall{{{1000 * uniform(random)}}};
    const glint::Elements set{wall};
    const glint::Ray<double> ray{{uniform(random), uniform(random), 1000 * uniform(random)},
                                 {uniform(random), uniform(random), uniform(random)}};
    const auto hit = set.intersect(ray, 0);
    if (!hit) continue;
    const auto s = set.surface(ray, *hit);
    CHECK(s.position == ray.at(hit->t));
    // The plane is at z exactly: what is left is the error.
    outside += std::abs(s.position.z - wall[0].z) > s.position_error.z ? 1 : 0;
  }
  CHECK(outside == 0);
}

TEMPLATE_TEST_CASE("elements: a primitive that knows its error keeps it, and sees the hit", "[geometry][elements]",
                   float, double) {
  using T = TestType;
  const std::array<glint::Triangle<T>, 1> one{{{{T(0), T(0), T(1)}, {T(1), T(0), T(1)}, {T(0), T(1), T(1)}}}};
  const glint::Elements set{one};
  const glint::Ray<T> ray{{T(0.25), T(0.5), T(0)}, {T(0), T(0), T(1)}};
  const auto hit = set.intersect(ray, 0);
  REQUIRE(hit);
  CHECK(set.surface(ray, *hit) == surface(one[0], ray.at(hit->t), *hit));
}

TEMPLATE_TEST_CASE("elements: clip where their primitives do", "[geometry][elements]", float, double) {
  using T = TestType;
  STATIC_REQUIRE_FALSE(glint::ClippableSet<glint::Elements<user::Wall>>);
  const std::array<glint::Triangle<T>, 1> one{{{{T(0), T(0), T(0)}, {T(4), T(0), T(0)}, {T(0), T(4), T(0)}}}};
  const glint::Elements set{one};
  STATIC_REQUIRE(glint::ClippableSet<decltype(set)>);
  const glint::Aabb<T> cell{{T(0), T(3), T(0)}, {T(4), T(4), T(0)}};
  CHECK(set.clip(0, cell) == clip(one[0], cell));
}

}  // namespace test_geometry_elements

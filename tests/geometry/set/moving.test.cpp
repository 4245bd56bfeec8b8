// SPDX-License-Identifier: MIT
#include <glint/geometry/set/moving.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <limits>
#include <vector>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_geometry_set_moving {

using glint::MeshBuffers;
using glint::Moving;
using glint::Ray;
using glint::Vec3;

namespace {

/// One triangle across the z axis, at this height.
template <typename T>
MeshBuffers<T> triangle_at(T z) {
  return {.positions = {{T(-1), T(-1), z}, {T(1), T(-1), z}, {T(0), T(1), z}},
          .normals = {{T(0), T(0), T(1)}, {T(0), T(0), T(1)}, {T(0), T(0), T(1)}},
          .uvs = {{T(0), T(0)}, {T(1), T(0)}, {T(0), T(1)}},
          .indices = {0, 1, 2}};
}

}  // namespace

TEMPLATE_TEST_CASE("moving: a ray meets a mesh where it is at the ray's time", "[geometry]", float, double) {
  using T = TestType;
  const auto a = triangle_at<T>(T(0));
  const auto b = triangle_at<T>(T(4));
  const auto c = triangle_at<T>(T(-4));
  const Moving two{view(a), view(b)};
  const Moving three{view(a), view(b), view(c)};
  static_assert(glint::MovingSet<decltype(two)> && glint::PreparedSet<decltype(two)>);
  static_assert(glint::ShadableSet<decltype(two)> && !glint::ClosestPointSet<decltype(two)>);
  const auto depth = [](const auto& set, T time) {
    const Ray<T> ray{.origin = {T(0), T(0), T(8)}, .time = time};
    const auto hit = set.intersect(ray, 0);
    REQUIRE(hit);
    CHECK(set.surface(ray, *hit).position.z == T(8) - hit->t);
    CHECK(set.surface(ray, *hit).shading_normal == Vec3<T>{T(0), T(0), T(1)});
    return hit->t;
  };
  // All numbers are exact: the height is 4 · time, or 8 · time up to the second key and from there 4 − 16 (time − ½).
  CHECK(depth(two, T(0)) == T(8));
  CHECK(depth(two, T(0.25)) == T(7));
  CHECK(depth(two, T(1)) == T(4));
  CHECK(depth(three, T(0.25)) == T(6));
  CHECK(depth(three, T(0.5)) == T(4));
  CHECK(depth(three, T(0.75)) == T(8));
  CHECK(depth(three, T(1)) == T(12));
}

TEMPLATE_TEST_CASE("moving: surfaces are those of a mesh built at that time", "[geometry]", float, double) {
  using T = TestType;
  const auto a = triangle_at<T>(T(0));
  auto b = triangle_at<T>(T(2));
  for (auto& normal : b.normals) normal = {T(1), T(0), T(0)};
  const Moving moving{view(a), view(b)};
  auto halfway = triangle_at<T>(T(1));
  for (auto& normal : halfway.normals) normal = {T(0.5), T(0), T(0.5)};
  const Ray<T> ray{.origin = {T(0.1), T(0.2), T(8)}, .time = T(0.5)};
  const auto hit = moving.intersect(ray, 0);
  REQUIRE(hit);
  CHECK(hit == view(halfway).intersect(ray, 0));
  const auto s = moving.surface(ray, *hit);
  const auto expected = view(halfway).surface(ray, *hit);
  CHECK(s.position == expected.position);
  CHECK(s.shading_normal == expected.shading_normal);
  CHECK(s.uv == expected.uv);
  CHECK(s.tangent == expected.tangent);
}

TEST_CASE("moving: bounds hold all keys, and a triangle that is not finite in one of them is never hit", "[geometry]") {
  const auto a = triangle_at<float>(0);
  auto b = triangle_at<float>(4);
  const Moving moving{view(a), view(b)};
  CHECK(moving.bounds(0).lower.z <= 0);
  CHECK(moving.bounds(0).upper.z >= 4);
  CHECK(moving.bounds(0).upper.z < 4.001F);
  b.positions[1].x = std::numeric_limits<float>::infinity();
  CHECK(is_empty(moving.bounds(0)));
  CHECK(is_empty(moving.motion_bounds(0).begin));
}

TEST_CASE("moving: a ray without a time meets nothing", "[geometry]") {
  const auto a = triangle_at<float>(0);
  const Moving moving{view(a), view(a)};
  CHECK(moving.intersect({.origin = {0, 0, 8}}, 0));
  CHECK_FALSE(moving.intersect({.origin = {0, 0, 8}, .time = std::numeric_limits<float>::quiet_NaN()}, 0));
}

}  // namespace test_geometry_set_moving

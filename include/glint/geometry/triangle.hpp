// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/clip.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A triangle; its outer side is the one that sees the vertices counterclockwise.
///
/// Units: scene units. Its uv are (0, 0), (1, 0), (1, 1) at the vertices.
template <std::floating_point T>
struct Triangle {
  Vec3<T> v0{T(0)};
  Vec3<T> v1{T(0)};
  Vec3<T> v2{T(0)};

  [[nodiscard]] friend bool operator==(const Triangle&, const Triangle&) noexcept = default;
};

template <std::floating_point T>
[[nodiscard]] Aabb<T> bounds(const Triangle<T>& triangle) noexcept {
  Aabb<T> box;
  extend(box, triangle.v0);
  extend(box, triangle.v1);
  extend(box, triangle.v2);
  return box;
}

/// The box of what the triangle has in a cell.
template <std::floating_point T>
[[nodiscard]] Aabb<T> clip(const Triangle<T>& triangle, const Aabb<T>& cell) noexcept {
  return clipped_bounds(std::array{triangle.v0, triangle.v1, triangle.v2}, cell);
}

/// The crossing of the triangle, from either side; uv are the weights of v1 and v2.
///
/// Errors: a NaN, a zero direction, and a triangle without area report no hit.
template <std::floating_point T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const Triangle<T>& triangle) noexcept {
  return Watertight::intersect(ray, Watertight::prepare(ray), triangle.v0, triangle.v1, triangle.v2);
}

namespace detail {

/// (v1 − v0) × (v2 − v0), divided by scale² on the way so that it neither underflows nor overflows.
template <std::floating_point T>
struct ScaledNormal {
  Vec3<T> e1;
  Vec3<T> e2;
  T scale = 0;          ///< the largest coordinate of the edges
  Vec3<T> cross{T(0)};  ///< zero for a triangle without area
  [[nodiscard]] T length() const noexcept { return glm::length(cross); }

  GLINT_ALWAYS_INLINE explicit ScaledNormal(const Triangle<T>& t) noexcept
      : e1(t.v1 - t.v0), e2(t.v2 - t.v0), scale(max_component(glm::max(abs(e1), abs(e2)))) {
    if (!(scale > T(0))) return;
    const T inverse = T(1) / scale;
    cross = glm::cross(e1 * inverse, e2 * inverse);
  }
};

}  // namespace detail

/// Units: scene units squared.
template <std::floating_point T>
[[nodiscard]] T area(const Triangle<T>& triangle) noexcept {
  const detail::ScaledNormal<T> normal(triangle);
  return T(0.5) * normal.length() * normal.scale * normal.scale;
}

/// The point v0 + w1 (v1 − v0) + w2 (v2 − v0).
///
/// The position is rounded once in each difference, product and sum: at most 3 times the size of the summands, and the
/// last sum. The error bound adds what the triangle tests lose when they look at the triangle from nearby, for a ray
/// that starts there must be beyond that too. They lose the more the thinner the triangle is; the bound stops growing
/// where it would exceed the thickness.
///
/// Errors: the normal of a triangle without area is (0, 0, 1).
/// Source: error analysis as in Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section 6.8.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE SurfaceOf<T> surface_at(const Triangle<T>& triangle, T w1, T w2) noexcept {
  const detail::ScaledNormal<T> frame(triangle);
  const T length = frame.length();
  const T inverse = T(1) / length;
  const T nearby = rounding_bound<T>(4) + std::min(rounding_bound<T>(8) * inverse, length);
  SurfaceOf<T> s;
  s.position = triangle.v0 + (frame.e1 * w1 + frame.e2 * w2);
  s.position_error = abs(s.position) * rounding_bound<T>(1) + Vec3<T>(frame.scale * nearby);
  if (length > T(0)) s.normal = frame.cross * inverse;
  s.shading_normal = s.normal;
  s.tangent = frame.e1;
  s.bitangent = frame.e2 - frame.e1;
  s.uv = {w1 + w2, w2};
  return s;
}

template <std::floating_point T>
[[nodiscard]] SurfaceOf<T> surface(const Triangle<T>& triangle, const Vec3<T>& /*position*/,
                                   const Hit<T>& hit) noexcept {
  return surface_at(triangle, hit.uv.x, hit.uv.y);
}

/// A point of the triangle, uniform by area for uniform u in [0, 1)², by a continuous map of little distortion, so
/// that well spread u give well spread points.
///
/// Errors: pdf is zero for a triangle without area.
/// Source: Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
template <std::floating_point T>
[[nodiscard]] AreaSample<T> sample_area(const Triangle<T>& triangle, const Vec2<T>& u) noexcept {
  const bool upper = u.y > u.x;
  const T half = T(0.5) * (upper ? u.x : u.y);
  const T w1 = upper ? half : u.x - half;
  const T w2 = upper ? u.y - half : half;
  const T size = area(triangle);
  return {surface_at(triangle, w1, w2), size > T(0) ? T(1) / size : T(0)};
}

/// The point of the segment from `a` to `b` closest to `point`.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_on_segment(const Vec3<T>& point, const Vec3<T>& a, const Vec3<T>& b) noexcept {
  const Vec3<T> way = b - a;
  const T squared = length_squared(way);
  if (!(squared > T(0))) return a;
  return a + way * std::clamp(glm::dot(point - a, way) / squared, T(0), T(1));
}

/// The point of the triangle closest to `point`; in slivers too, it is closest to a few roundings of the coordinates.
/// A foot inside is measured along an edge, and what that leaves across it: weights that are differences of products of
/// edges would mean little where the height is lost in them.
///
/// Errors: a triangle without area is what its edges are.
template <std::floating_point T>
[[nodiscard]] Vec3<T> closest_point(const Vec3<T>& point, const Triangle<T>& triangle) noexcept {
  const auto& [a, b, c] = triangle;
  Vec3<T> best = closest_on_segment(point, a, b);
  T least = length_squared(best - point);
  const auto consider = [&](const Vec3<T>& candidate) {
    const T squared = length_squared(candidate - point);
    if (!(squared < least)) return;
    best = candidate;
    least = squared;
  };
  consider(closest_on_segment(point, b, c));
  consider(closest_on_segment(point, c, a));
  const Vec3<T> base = b - a;
  const T base_squared = length_squared(base);
  const T skew = glm::dot(base, c - a) / base_squared;
  const Vec3<T> height = c - a - base * skew;
  const T along = glm::dot(base, point - a) / base_squared;
  const T up = glm::dot(height, point - a - base * along) / length_squared(height);
  if (up > T(0) && along - skew * up > T(0) && along + (T(1) - skew) * up < T(1))
    consider(a + (base * along + height * up));
  return best;
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/region.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/rounding.hpp>
#include <glint/math/vec.hpp>

/// Which primitives overlap a region: `bool overlaps(const P&, const R&)`, found by argument-dependent lookup, says it
/// for a primitive of the user's as for those here. Surfaces count, not what they enclose. What lies in a region
/// overlaps it.
namespace glint {
namespace detail {

template <std::floating_point T>
[[nodiscard]] bool has_nan(const Triangle<T>& t) noexcept {
  const Vec3<T> sum = t.v0 + t.v1 + t.v2;
  return std::isnan(sum.x + sum.y + sum.z);
}

/// Whether an axis that is perpendicular to an edge of a triangle and to one of a box parts them by more than rounding.
/// The two ends of the edge are at the same place on it.
template <std::floating_point W>
[[nodiscard]] bool is_parted(W edge_u, W edge_v, const Vec2<W>& on_edge, const Vec2<W>& opposite, W half_u,
                             W half_v) noexcept {
  const W at_edge = on_edge.x * edge_v - on_edge.y * edge_u;
  const W at_opposite = opposite.x * edge_v - opposite.y * edge_u;
  const W size = std::abs(edge_u) + std::abs(edge_v);
  const W far = std::max({std::abs(on_edge.x), std::abs(on_edge.y), std::abs(opposite.x), std::abs(opposite.y)});
  const W reach = half_u * std::abs(edge_v) + half_v * std::abs(edge_u) + rounding_bound<W>(8) * far * size;
  return std::min(at_edge, at_opposite) > reach || std::max(at_edge, at_opposite) < -reach;
}

/// The axes of all pairs of edges, and the triangle's normal. Coordinates are those from the box's center.
template <std::floating_point W>
[[nodiscard]] bool is_parted_from_box(const std::array<Vec3<W>, 3>& v, const Vec3<W>& half) noexcept {
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3<W>& a = v[i];
    const Vec3<W>& c = v[(i + 2) % 3];
    const Vec3<W> e = v[(i + 1) % 3] - a;
    if (is_parted<W>(e.x, e.y, {a.x, a.y}, {c.x, c.y}, half.x, half.y)) return true;
    if (is_parted<W>(e.y, e.z, {a.y, a.z}, {c.y, c.z}, half.y, half.z)) return true;
    if (is_parted<W>(e.z, e.x, {a.z, a.x}, {c.z, c.x}, half.z, half.x)) return true;
  }
  const Vec3<W> e1 = v[1] - v[0];
  const Vec3<W> e2 = v[2] - v[0];
  const Vec3<W> normal = glm::cross(e1, e2);
  const W far = max_component(max(abs(v[0]), half));
  const W rounding = rounding_bound<W>(16) * far * max_component(abs(e1)) * max_component(abs(e2));
  return std::abs(glm::dot(normal, v[0])) > glm::dot(abs(normal), half) + rounding;
}

}  // namespace detail

/// Whether a triangle and a box have a point in common: exact, but that triangles count which miss the box by what
/// rounding in the next wider type makes of it. One without area counts as the segment or point that it is.
///
/// Errors: false where anything is NaN, here and for other regions.
/// Source: Akenine-Möller, "Fast 3D Triangle-Box Overlap Testing", Journal of Graphics Tools 6(1), 2001; here of the
///         part of the box that is within the triangle's own, in double precision, and with bounds for rounding.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Triangle<T>& triangle, const Aabb<T>& box) noexcept {
  using W = Wide<T>;
  const Aabb<T> part = overlap(box, bounds(triangle));
  if (is_empty(part) || detail::has_nan(triangle)) return false;
  if (contains(box, triangle.v0) || contains(box, triangle.v1) || contains(box, triangle.v2)) return true;
  const Vec3<W> lower(part.lower);
  const Vec3<W> upper(part.upper);
  const Vec3<W> center = (lower + upper) * W(0.5);
  const std::array<Vec3<W>, 3> v{Vec3<W>(triangle.v0) - center, Vec3<W>(triangle.v1) - center,
                                 Vec3<W>(triangle.v2) - center};
  return !detail::is_parted_from_box(v, max(center - lower, upper - center));
}

/// Whether a triangle and a frustum have a point in common: what six cuts leave of the triangle, but for rounding in
/// the next wider type.
///
/// Source: Sutherland, Hodgman, "Reentrant Polygon Clipping", Communications of the ACM 17(1), 1974.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Triangle<T>& triangle, const Frustum<T>& frustum) noexcept {
  using W = Wide<T>;
  if (detail::has_nan(triangle)) return false;
  std::array<Vec3<W>, 9> from{Vec3<W>(triangle.v0), Vec3<W>(triangle.v1), Vec3<W>(triangle.v2)};
  std::size_t count = 3;
  for (const HalfSpace<T>& side : frustum.sides) {
    const Vec3<W> normal(side.normal);
    const auto height = [&](const Vec3<W>& p) { return glm::dot(normal, p) + W(side.offset); };
    std::array<Vec3<W>, 9> kept{};
    std::size_t kept_count = 0;
    const auto keep = [&](const Vec3<W>& p) {
      if (kept_count < kept.size()) kept[kept_count++] = p;  // rounding may bend what is convex, and then cut too often
    };
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3<W>& a = from[i];
      const Vec3<W>& b = from[(i + 1) % count];
      const W at_a = height(a);
      const W at_b = height(b);
      if (at_a >= W(0)) keep(a);
      if ((at_a > W(0) && at_b < W(0)) || (at_a < W(0) && at_b > W(0))) keep(a + (b - a) * (at_a / (at_a - at_b)));
    }
    if (kept_count == 0) return false;
    from = kept;
    count = kept_count;
  }
  return true;
}

template <std::floating_point T>
[[nodiscard]] bool overlaps(const Triangle<T>& triangle, const Ball<T>& ball) noexcept {
  return !detail::has_nan(triangle) &&
         length_squared(closest_point(ball.center, triangle) - ball.center) <= ball.radius * ball.radius;
}

/// A quad is its two halves.
template <std::floating_point T, typename Region>
  requires std::same_as<Region, Aabb<T>> || std::same_as<Region, Frustum<T>>
[[nodiscard]] bool overlaps(const Quad<T>& quad, const Region& region) noexcept {
  const Vec3<T> u = quad.origin + quad.edge_u;
  const Vec3<T> v = quad.origin + quad.edge_v;
  return overlaps(Triangle<T>{quad.origin, u, v}, region) ||
         overlaps(Triangle<T>{u, quad.origin + (quad.edge_u + quad.edge_v), v}, region);
}

/// The sphere, not the ball: a box within overlaps nothing.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Sphere<T>& sphere, const Aabb<T>& box) noexcept {
  const T squared = sphere.radius * sphere.radius;
  return !is_empty(box) && length_squared(detail::way_to(box, sphere.center)) <= squared &&
         length_squared(detail::way_past(box, sphere.center)) >= squared;
}

/// False only where one side has all of the sphere outside: a sphere beyond an edge of the frustum may pass, and one
/// around it.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Sphere<T>& sphere, const Frustum<T>& frustum) noexcept {
  return std::all_of(frustum.sides.begin(), frustum.sides.end(), [&](const HalfSpace<T>& side) {
    return glm::dot(side.normal, sphere.center) + side.offset >=
           -sphere.radius * std::sqrt(length_squared(side.normal));
  });
}

/// What knows its closest point knows whether it reaches into a ball.
template <ClosestPointPrimitive P>
[[nodiscard]] bool overlaps(const P& primitive, const Ball<ScalarOf<P>>& ball) noexcept {
  const auto way = detail::closest_point_of(ball.center, primitive) - ball.center;
  return length_squared(way) <= ball.radius * ball.radius;
}

namespace detail {

/// What `overlaps` says of a primitive, a box included, and a region; where it says nothing, what it says of the
/// primitive's box.
template <typename P, typename Region>
[[nodiscard]] bool overlaps_region(const P& primitive, const Region& region) {
  if constexpr (requires { overlaps(primitive, region); })
    return overlaps(primitive, region);
  else
    return overlaps(bounds_of(primitive), region);
}

/// Shows a primitive of a set to `f`; a set that does not hand out its primitives shows boxes.
template <BoundedSet S, typename F>
auto with_primitive(const S& set, typename S::Index i, const F& f) {
  if constexpr (requires { set.with_primitive(i, f); })
    return set.with_primitive(i, f);
  else
    return f(set.bounds(i));
}

}  // namespace detail

/// Whether a primitive of a set overlaps a region, by `overlaps` for its type; else whether its box does.
template <BoundedSet S, typename Region>
[[nodiscard]] bool overlaps(const S& set, typename S::Index i, const Region& region) {
  return detail::with_primitive(set, i,
                                [&](const auto& primitive) { return detail::overlaps_region(primitive, region); });
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/overlap.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/orientation.hpp>
#include <glint/math/vec.hpp>

namespace glint {
namespace detail {

/// A triangle as the exact tests go through it.
template <std::floating_point T>
using Corners = std::array<Vec3<T>, 3>;

template <std::floating_point T>
[[nodiscard]] Vec2<T> without_axis(const Vec3<T>& v, int axis) noexcept {
  return axis == 0 ? Vec2<T>{v.y, v.z} : axis == 1 ? Vec2<T>{v.z, v.x} : Vec2<T>{v.x, v.y};
}
template <std::floating_point T>
[[nodiscard]] int orientation_without(int axis, const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c) noexcept {
  return orientation(without_axis(a, axis), without_axis(b, axis), without_axis(c, axis));
}

/// An axis along which the triangle is seen to have an area; 3 for none.
template <std::floating_point T>
[[nodiscard]] int open_axis(const Corners<T>& t) noexcept {
  int axis = 0;
  while (axis < 3 && orientation_without(axis, t[0], t[1], t[2]) == 0) ++axis;
  return axis;
}

/// In the plane of two segments, seen along an axis.
template <std::floating_point T>
[[nodiscard]] bool segments_meet(int axis, const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& a,
                                 const Vec3<T>& b) noexcept {
  const int at_a = orientation_without(axis, p, q, a);
  const int at_b = orientation_without(axis, p, q, b);
  if (at_a == 0 && at_b == 0) {  // on one line
    Aabb<T> first{p, p};
    extend(first, q);
    Aabb<T> second{a, a};
    extend(second, b);
    return overlaps(first, second);
  }
  return at_a * at_b <= 0 && orientation_without(axis, a, b, p) * orientation_without(axis, a, b, q) <= 0;
}
template <std::floating_point T>
[[nodiscard]] bool holds_in_plane(int axis, const Corners<T>& t, const Vec3<T>& p) noexcept {
  const int s0 = orientation_without(axis, t[0], t[1], p);
  const int s1 = orientation_without(axis, t[1], t[2], p);
  const int s2 = orientation_without(axis, t[2], t[0], p);
  return std::min({s0, s1, s2}) >= 0 || std::max({s0, s1, s2}) <= 0;
}
template <std::floating_point T>
[[nodiscard]] bool segment_meets_in_plane(int axis, const Vec3<T>& p, const Vec3<T>& q, const Corners<T>& t) noexcept {
  return holds_in_plane(axis, t, p) || holds_in_plane(axis, t, q) || segments_meet(axis, p, q, t[0], t[1]) ||
         segments_meet(axis, p, q, t[1], t[2]) || segments_meet(axis, p, q, t[2], t[0]);
}
template <std::floating_point T>
[[nodiscard]] bool overlap_in_plane(const Corners<T>& a, const Corners<T>& b) noexcept {
  const int axis = open_axis(a);
  if (axis == 3 || orientation_without(axis, b[0], b[1], b[2]) == 0) return false;
  return holds_in_plane(axis, a, b[0]) || segment_meets_in_plane(axis, a[0], a[1], b) ||
         segment_meets_in_plane(axis, a[1], a[2], b) || segment_meets_in_plane(axis, a[2], a[0], b);
}

/// On which sides of a triangle's plane the corners of another are.
template <std::floating_point T>
[[nodiscard]] std::array<int, 3> sides_of(const Corners<T>& plane, const Corners<T>& t) noexcept {
  return {orientation(plane[0], plane[1], plane[2], t[0]), orientation(plane[0], plane[1], plane[2], t[1]),
          orientation(plane[0], plane[1], plane[2], t[2])};
}
[[nodiscard]] inline bool is_one_sided(const std::array<int, 3>& sides) noexcept {
  return sides[0] != 0 && sides[0] == sides[1] && sides[1] == sides[2];
}
[[nodiscard]] inline bool is_in_plane(const std::array<int, 3>& sides) noexcept {
  return sides[0] == 0 && sides[1] == 0 && sides[2] == 0;
}

/// Whether a segment meets a triangle, given the sides of its plane on which the ends are.
template <std::floating_point T>
[[nodiscard]] bool segment_meets(const Vec3<T>& p, const Vec3<T>& q, int side_p, int side_q,
                                 const Corners<T>& t) noexcept {
  if (side_p * side_q > 0) return false;
  if (side_p == 0 && side_q == 0) {
    const int axis = open_axis(t);
    return axis < 3 && segment_meets_in_plane(axis, p, q, t);
  }
  const int s0 = orientation(p, q, t[0], t[1]);
  const int s1 = orientation(p, q, t[1], t[2]);
  if (s0 * s1 < 0) return false;
  const int s2 = orientation(p, q, t[2], t[0]);
  return s0 * s2 >= 0 && s1 * s2 >= 0;
}
template <std::floating_point T>
[[nodiscard]] bool segment_meets(const Vec3<T>& p, const Vec3<T>& q, const Corners<T>& t) noexcept {
  return segment_meets(p, q, orientation(t[0], t[1], t[2], p), orientation(t[0], t[1], t[2], q), t);
}
template <std::floating_point T>
[[nodiscard]] bool an_edge_meets(const Corners<T>& from, const std::array<int, 3>& sides,
                                 const Corners<T>& t) noexcept {
  for (std::size_t i = 0; i < 3; ++i)
    if (segment_meets(from[i], from[(i + 1) % 3], sides[i], sides[(i + 1) % 3], t)) return true;
  return false;
}

template <std::floating_point T>
[[nodiscard]] bool overlap_of(const Corners<T>& a, const Corners<T>& b) noexcept {
  const std::array<int, 3> sides_of_b = sides_of(a, b);
  if (is_one_sided(sides_of_b)) return false;
  const std::array<int, 3> sides_of_a = sides_of(b, a);
  if (is_one_sided(sides_of_a)) return false;
  if (is_in_plane(sides_of_a) || is_in_plane(sides_of_b)) return overlap_in_plane(a, b);
  return an_edge_meets(a, sides_of_a, b) || an_edge_meets(b, sides_of_b, a);
}

/// The corners that two triangles share are put first in both. Returns how many there are.
template <std::floating_point T>
[[nodiscard]] std::size_t bring_shared_first(Corners<T>& a, Corners<T>& b) noexcept {
  std::size_t shared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto same = std::find(b.begin() + std::ptrdiff_t(shared), b.end(), a[i]);
    if (same == b.end()) continue;
    std::swap(a[shared], a[i]);
    std::swap(b[shared], *same);
    ++shared;
  }
  return shared;
}

}  // namespace detail

/// Whether two triangles have a point in common, exactly, those in one plane and those that touch included.
///
/// Ensures: the same for the other order, of the triangles and of their corners.
/// Errors:  false for a NaN, and for a triangle without area. As orientation, for coordinates out of range.
/// Source:  Guigue, Devillers, "Fast and Robust Triangle-Triangle Overlap Test Using Orientation Predicates", Journal
/// of
///          Graphics Tools 8(1), 2003, for deciding by orientations alone; here each edge is tried on the other
///          triangle.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Triangle<T>& a, const Triangle<T>& b) noexcept {
  if (detail::has_nan(a) || detail::has_nan(b)) return false;
  return detail::overlap_of<T>({a.v0, a.v1, a.v2}, {b.v0, b.v1, b.v2});
}

/// Whether two triangles of a surface run into each other: whether they have a point in common other than the corner or
/// the edge that they share. Corners are shared where their coordinates are equal. Triangles that share all three
/// overlap.
///
/// A segment between common points is common, so it suffices to look at the edges that are opposite to a shared corner;
/// triangles that share an edge have more in common only if they are folded onto each other.
///
/// Ensures, Errors: as overlaps.
template <std::floating_point T>
[[nodiscard]] bool overlaps_beyond_corners(const Triangle<T>& a, const Triangle<T>& b) noexcept {
  if (detail::has_nan(a) || detail::has_nan(b)) return false;
  detail::Corners<T> p{a.v0, a.v1, a.v2};
  detail::Corners<T> q{b.v0, b.v1, b.v2};
  const std::size_t shared = detail::bring_shared_first(p, q);
  if (shared == 0) return detail::overlap_of(p, q);
  if (shared == 2 && orientation(p[0], p[1], p[2], q[2]) != 0) return false;
  if (shared == 1 && !detail::segment_meets(p[1], p[2], q) && !detail::segment_meets(q[1], q[2], p)) return false;
  const int axis = detail::open_axis(p);
  if (axis == 3 || detail::open_axis(q) == 3) return false;
  if (shared != 2) return true;
  return detail::orientation_without(axis, p[0], p[1], p[2]) == detail::orientation_without(axis, p[0], p[1], q[2]);
}

}  // namespace glint

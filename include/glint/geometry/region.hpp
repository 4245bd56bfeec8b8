// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

/// Convex regions of space that one looks for primitives in. A box is another: Aabb.
///
/// A region of the user's is a type with `overlaps(const Aabb<T>&, const R&)`, which may say yes too often, and
/// `contains(const R&, const Aabb<T>&)`, which may say no too often, both found by argument-dependent lookup.
namespace glint {

/// All points within a distance of a center, that distance included.
///
/// Requires: radius ≥ 0; its square is in T's range.
template <std::floating_point T>
struct Ball {
  Vec3<T> center{T(0)};
  T radius = 1;

  [[nodiscard]] friend bool operator==(const Ball&, const Ball&) noexcept = default;
};

/// The points p with dot(normal, p) + offset ≥ 0. The normal may have any length.
template <std::floating_point T>
struct HalfSpace {
  Vec3<T> normal{T(0)};
  T offset = 0;

  [[nodiscard]] friend bool operator==(const HalfSpace&, const HalfSpace&) noexcept = default;
};

/// What six half-spaces have in common: what a camera sees, a box that is turned. The default is all of space.
template <std::floating_point T>
struct Frustum {
  std::array<HalfSpace<T>, 6> sides{};

  [[nodiscard]] friend bool operator==(const Frustum&, const Frustum&) noexcept = default;
};

/// What a matrix maps into the cube −w ≤ x, y, z ≤ w: `frustum_of(glm::perspective(…) * glm::lookAt(…))`. Of a matrix
/// for depths from 0 to 1, the near side comes out nearer to the eye than it is.
///
/// Source: Gribb, Hartmann, "Fast Extraction of Viewing Frustum Planes from the World-View-Projection Matrix", 2001.
template <std::floating_point T, glm::qualifier Q>
[[nodiscard]] Frustum<T> frustum_of(const glm::mat<4, 4, T, Q>& projection) noexcept {
  const auto row = [&](int i) {
    return glm::vec<4, T, Q>(projection[0][i], projection[1][i], projection[2][i], projection[3][i]);
  };
  const auto side = [](const glm::vec<4, T, Q>& plane) { return HalfSpace<T>{{plane.x, plane.y, plane.z}, plane.w}; };
  return {{side(row(3) + row(0)), side(row(3) - row(0)), side(row(3) + row(1)), side(row(3) - row(1)),
           side(row(3) + row(2)), side(row(3) - row(2))}};
}

/// Requires: not an empty box; finite.
template <std::floating_point T>
[[nodiscard]] Frustum<T> frustum_of(const Aabb<T>& box) noexcept {
  const Vec3<T> x{T(1), T(0), T(0)};
  const Vec3<T> y{T(0), T(1), T(0)};
  const Vec3<T> z{T(0), T(0), T(1)};
  return {{HalfSpace<T>{x, -box.lower.x}, HalfSpace<T>{-x, box.upper.x}, HalfSpace<T>{y, -box.lower.y},
           HalfSpace<T>{-y, box.upper.y}, HalfSpace<T>{z, -box.lower.z}, HalfSpace<T>{-z, box.upper.z}}};
}

/// The image of a frustum under a map. Requires: `to_local` is the map's inverse.
template <std::floating_point T>
[[nodiscard]] Frustum<T> transform_by_inverse(const Affine<T>& to_local, const Frustum<T>& frustum) noexcept {
  Frustum<T> image = frustum;
  for (HalfSpace<T>& side : image.sides) {
    side.offset += glm::dot(side.normal, to_local.translation);
    side.normal = to_local.transposed_vector(side.normal);
  }
  return image;
}

/// Whether boxes have a point in common; an empty box has none.
template <std::floating_point T>
[[nodiscard]] constexpr bool overlaps(const Aabb<T>& a, const Aabb<T>& b) noexcept {
  return !is_empty(overlap(a, b));
}

namespace detail {

/// From a point to a box along each axis; zero where the point is between the faces.
template <std::floating_point T>
[[nodiscard]] Vec3<T> way_to(const Aabb<T>& box, const Vec3<T>& point) noexcept {
  const auto outside = [](T lower, T upper, T x) { return std::max(std::max(lower - x, x - upper), T(0)); };
  return {outside(box.lower.x, box.upper.x, point.x), outside(box.lower.y, box.upper.y, point.y),
          outside(box.lower.z, box.upper.z, point.z)};
}
/// From a point to the farthest corner of a box.
template <std::floating_point T>
[[nodiscard]] Vec3<T> way_past(const Aabb<T>& box, const Vec3<T>& point) noexcept {
  const auto farthest = [](T lower, T upper, T x) { return std::max(x - lower, upper - x); };
  return {farthest(box.lower.x, box.upper.x, point.x), farthest(box.lower.y, box.upper.y, point.y),
          farthest(box.lower.z, box.upper.z, point.z)};
}

/// The corner of a box that is farthest in a direction.
template <std::floating_point T>
[[nodiscard]] Vec3<T> corner_toward(const Aabb<T>& box, const Vec3<T>& direction) noexcept {
  return {direction.x < T(0) ? box.lower.x : box.upper.x, direction.y < T(0) ? box.lower.y : box.upper.y,
          direction.z < T(0) ? box.lower.z : box.upper.z};
}

}  // namespace detail

template <std::floating_point T>
[[nodiscard]] bool overlaps(const Aabb<T>& box, const Ball<T>& ball) noexcept {
  return !is_empty(box) && length_squared(detail::way_to(box, ball.center)) <= ball.radius * ball.radius;
}
template <std::floating_point T>
[[nodiscard]] bool contains(const Ball<T>& ball, const Aabb<T>& box) noexcept {
  return is_empty(box) || length_squared(detail::way_past(box, ball.center)) <= ball.radius * ball.radius;
}

/// False only where one side has all of the box outside: a box beyond an edge of the frustum may pass.
template <std::floating_point T>
[[nodiscard]] bool overlaps(const Aabb<T>& box, const Frustum<T>& frustum) noexcept {
  return !is_empty(box) && std::all_of(frustum.sides.begin(), frustum.sides.end(), [&](const HalfSpace<T>& side) {
    return glm::dot(side.normal, detail::corner_toward(box, side.normal)) + side.offset >= T(0);
  });
}
template <std::floating_point T>
[[nodiscard]] bool contains(const Frustum<T>& frustum, const Aabb<T>& box) noexcept {
  return is_empty(box) || std::all_of(frustum.sides.begin(), frustum.sides.end(), [&](const HalfSpace<T>& side) {
           return glm::dot(side.normal, detail::corner_toward(box, -side.normal)) + side.offset >= T(0);
         });
}

}  // namespace glint

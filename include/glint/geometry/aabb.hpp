// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glm/common.hpp>

#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// An axis-aligned bounding box, faces included. The default is empty: it holds no point and is neutral in unions.
template <std::floating_point T>
struct Aabb {
  Vec3<T> lower{infinity<T>};
  Vec3<T> upper{-infinity<T>};

  [[nodiscard]] friend bool operator==(const Aabb&, const Aabb&) noexcept = default;
};

/// Grows the box to hold the point. A NaN coordinate leaves its axis unchanged.
template <std::floating_point T>
constexpr void extend(Aabb<T>& box, const Vec3<T>& point) noexcept {
  box.lower = glm::min(box.lower, point);
  box.upper = glm::max(box.upper, point);
}

template <std::floating_point T>
constexpr void extend(Aabb<T>& box, const Aabb<T>& other) noexcept {
  box.lower = glm::min(box.lower, other.lower);
  box.upper = glm::max(box.upper, other.upper);
}

template <std::floating_point T>
[[nodiscard]] constexpr Aabb<T> join(Aabb<T> a, const Aabb<T>& b) noexcept {
  extend(a, b);
  return a;
}

/// The box of the points common to both; empty where they are apart.
template <std::floating_point T>
[[nodiscard]] constexpr Aabb<T> overlap(const Aabb<T>& a, const Aabb<T>& b) noexcept {
  return {glm::max(a.lower, b.lower), glm::min(a.upper, b.upper)};
}

/// True where any axis holds no point, or has a NaN.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_empty(const Aabb<T>& box) noexcept {
  return !(box.lower.x <= box.upper.x && box.lower.y <= box.upper.y && box.lower.z <= box.upper.z);
}

/// Neither empty nor infinite: the boxes that trees take.
template <std::floating_point T>
[[nodiscard]] bool is_bounded(const Aabb<T>& box) noexcept {
  return is_finite(box.lower) && is_finite(box.upper) && !is_empty(box);
}

template <std::floating_point T>
[[nodiscard]] constexpr bool contains(const Aabb<T>& box, const Vec3<T>& p) noexcept {
  return box.lower.x <= p.x && p.x <= box.upper.x && box.lower.y <= p.y && p.y <= box.upper.y && box.lower.z <= p.z &&
         p.z <= box.upper.z;
}

/// True where `inner` lies in `outer`; an empty box lies in every box.
template <std::floating_point T>
[[nodiscard]] constexpr bool contains(const Aabb<T>& outer, const Aabb<T>& inner) noexcept {
  return is_empty(inner) || (contains(outer, inner.lower) && contains(outer, inner.upper));
}

/// Half scaled before adding, so that boxes near the largest number have a centroid.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3<T> centroid(const Aabb<T>& box) noexcept {
  return box.lower * T(0.5) + box.upper * T(0.5);
}

/// Edge lengths; of no meaning for an empty box.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3<T> extent(const Aabb<T>& box) noexcept {
  return box.upper - box.lower;
}

/// The area of half the box's surface, what the surface area heuristic compares; zero for an empty box.
template <std::floating_point T>
[[nodiscard]] constexpr T half_area(const Aabb<T>& box) noexcept {
  if (is_empty(box)) return T(0);
  const Vec3<T> e = extent(box);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace glint

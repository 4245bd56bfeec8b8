// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, 4> packed(const Vec3<T>& v) noexcept {
  auto p = Pack<T, 4>::broadcast(T(0));  // lane by lane: wide loads of narrow stores stall
  p.set(0, v.x);
  p.set(1, v.y);
  p.set(2, v.z);
  return p;
}
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE Vec3<T> unpacked(const Pack<T, 4>& p) noexcept {
  return {p[0], p[1], p[2]};
}

/// A polygon of N corners, from which half-spaces are cut off, six at most.
template <std::floating_point T, std::size_t N>
class CutPolygon {
 public:
  explicit CutPolygon(const std::array<Pack<T, 4>, N>& corners) noexcept {
    std::copy(corners.begin(), corners.end(), vertices_[0].begin());
  }

  /// Keeps what is on one side of a plane: above for a `sign` of one, below for minus one.
  GLINT_ALWAYS_INLINE void keep(int axis, T plane, T sign) noexcept {
    if (size_ == 0) return;
    const auto& from = vertices_[which_];
    auto& to = vertices_[1 - which_];
    std::size_t kept = 0;
    Pack<T, 4> before = from[size_ - 1];
    T height_before = (before[axis] - plane) * sign;
    for (std::size_t i = 0; i < size_; ++i) {  // written always, kept at times: no branch to guess
      const Pack<T, 4> vertex = from[i];
      const T height = (vertex[axis] - plane) * sign;
      const T share = height_before / (height_before - height);
      to[kept] = before + fenced((vertex - before) * Pack<T, 4>::broadcast(share));
      to[kept].set(axis, plane);
      kept += std::size_t((height >= T(0)) != (height_before >= T(0)));
      to[kept] = vertex;
      kept += std::size_t(height >= T(0));
      before = vertex;
      height_before = height;
    }
    size_ = kept;
    which_ = 1 - which_;
  }

  /// The corners of its box; infinite and inverted where nothing was kept.
  [[nodiscard]] Pack<T, 4> lower() const noexcept {
    auto result = Pack<T, 4>::broadcast(infinity<T>);
    for (std::size_t i = 0; i < size_; ++i) result = min(vertices_[which_][i], result);
    return result;
  }
  [[nodiscard]] Pack<T, 4> upper() const noexcept {
    auto result = Pack<T, 4>::broadcast(-infinity<T>);
    for (std::size_t i = 0; i < size_; ++i) result = max(vertices_[which_][i], result);
    return result;
  }

 private:
  /// A cut adds a vertex where it crosses an edge. Two crossings enclose a vertex that goes, so even where rounding
  /// made the polygon concave, no cut adds more than half. One more is written, and not kept.
  static constexpr std::size_t capacity = [] {
    std::size_t n = N;
    for (int cut = 0; cut < 6; ++cut) n += n / 2;
    return n + 1;
  }();

  std::array<std::array<Pack<T, 4>, capacity>, 2> vertices_;
  std::size_t which_ = 0;
  std::size_t size_ = N;
};

}  // namespace detail

/// The box of that part of a convex polygon which lies in a cell; empty where there is none.
///
/// A cut loses 6 roundings of the polygon's size, and six cuts may follow each other. So the cell is widened by more
/// than that before, and the box after: enough for a hit that a triangle test sees by its own rounding, too.
///
/// Requires: finite corners.
/// Ensures:  within the cell and the polygon's box; holds every point of the polygon in the cell, and nothing that is
///           further than about 128 roundings of the polygon's size from what it has within as much of the cell.
/// Source:   Sutherland, Hodgman, "Reentrant Polygon Clipping", CACM 17(1), 1974.
template <std::floating_point T, std::size_t N>
[[nodiscard]] Aabb<T> clipped_bounds(const std::array<Vec3<T>, N>& corners, const Aabb<T>& cell) noexcept {
  using P = Pack<T, 4>;
  const P origin = detail::packed(corners[0]);
  std::array<P, N> relative;
  P low = P::broadcast(infinity<T>);
  P high = P::broadcast(-infinity<T>);
  for (std::size_t i = 0; i < N; ++i) {
    const P corner = detail::packed(corners[i]);
    low = min(corner, low);
    high = max(corner, high);
    relative[i] = corner - origin;
  }
  const P common_low = max(detail::packed(cell.lower), low);
  const P common_high = min(detail::packed(cell.upper), high);
  if (less(common_high, common_low) != 0) return {};
  const Aabb<T> common{detail::unpacked(common_low), detail::unpacked(common_high)};
  const T size = max_component(detail::unpacked(high - low));
  const std::uint32_t above = less(low, common_low);
  const std::uint32_t below = less(common_high, high);
  if ((above | below) == 0 || !(size <= std::numeric_limits<T>::max())) return common;

  const P magnitude = max(high, P::broadcast(T(0)) - low);
  const T far = max_component(detail::unpacked(magnitude));
  const T margin =
      fenced(rounding_bound<T>(64) * size) + fenced(rounding_bound<T>(4) * far) + std::numeric_limits<T>::min();
  const P margins = P::broadcast(margin);
  const P cut_low = (common_low - origin) - margins;
  const P cut_high = (common_high - origin) + margins;
  detail::CutPolygon<T, N> polygon(relative);
  for (int axis = 0; axis < 3; ++axis) {
    if ((above >> axis & 1U) != 0) polygon.keep(axis, cut_low[axis], T(1));
    if ((below >> axis & 1U) != 0) polygon.keep(axis, cut_high[axis], T(-1));
  }
  const P part_low = max((polygon.lower() - margins) + origin, common_low);
  const P part_high = min((polygon.upper() + margins) + origin, common_high);
  if (less(part_high, part_low) != 0) return {};
  return {detail::unpacked(part_low), detail::unpacked(part_high)};
}

}  // namespace glint

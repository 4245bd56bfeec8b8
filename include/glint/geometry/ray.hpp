// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>

#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The points origin + t · direction, t_min ≤ t ≤ t_max.
///
/// Units:  origin and direction in scene units; t in multiples of |direction|, which may have any length but zero.
/// Errors: a zero direction, a NaN anywhere, or t_min > t_max meets nothing.
template <std::floating_point T>
struct Ray {
  Vec3<T> origin{T(0)};
  Vec3<T> direction{T(0), T(0), T(-1)};
  T t_min = 0;
  T t_max = infinity<T>;
  T time = 0;                              ///< in [0, 1] over the shutter; static sets ignore it
  std::uint32_t mask = ~std::uint32_t{0};  ///< what it sees of Masked sets: all that share a bit with it

  [[nodiscard]] Vec3<T> at(T t) const noexcept { return origin + direction * t; }

  [[nodiscard]] friend bool operator==(const Ray&, const Ray&) noexcept = default;
};

}  // namespace glint

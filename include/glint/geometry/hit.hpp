// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>

#include <glint/core/index.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Where a ray meets a primitive.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct Hit {
  T t = 0;                ///< in multiples of the ray's direction
  Vec2<T> uv{T(0)};       ///< the intersector's parameters; triangle: weights of vertices 1 and 2
  I primitive = none<I>;  ///< the caller's own index in the set
  I inner = none<I>;      ///< where the primitive is an object placed by Instanced: which primitive within it

  [[nodiscard]] friend bool operator==(const Hit&, const Hit&) noexcept = default;
};

}  // namespace glint

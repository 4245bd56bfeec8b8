// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>

#include <glint/math/vec.hpp>

namespace glint {

/// A right-handed orthonormal basis: x × y = z. In shading frames z is the normal.
template <std::floating_point T>
struct Frame {
  Vec3<T> x{1, 0, 0};
  Vec3<T> y{0, 1, 0};
  Vec3<T> z{0, 0, 1};

  /// The frame around a unit vector z; x and y are arbitrary but continuous away from z.z = 0.
  ///
  /// Requires: |z| = 1.
  /// Source:   Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 6(1), 2017.
  [[nodiscard]] static Frame around(const Vec3<T>& z) noexcept {
    const T sign = std::copysign(T(1), z.z);
    const T a = T(-1) / (sign + z.z);
    const T b = z.x * z.y * a;
    return {{T(1) + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
  }

  /// The frame around a unit vector z whose x is `tangent` made perpendicular to z; any x where that has no length.
  [[nodiscard]] static Frame from_normal_and_tangent(const Vec3<T>& z, const Vec3<T>& tangent) noexcept {
    Frame result;  // all returns are of this object, which the caller then has without a copy
    const Vec3<T> across = tangent - z * glm::dot(tangent, z);
    const T squared = length_squared(across);
    if (squared > T(0) && std::isfinite(squared)) {
      result.x = across * (T(1) / std::sqrt(squared));
      result.y = glm::cross(z, result.x);
      result.z = z;
    } else {
      result = around(z);
    }
    return result;
  }

  [[nodiscard]] Vec3<T> to_local(const Vec3<T>& v) const noexcept {
    return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)};
  }
  [[nodiscard]] Vec3<T> to_world(const Vec3<T>& v) const noexcept { return x * v.x + y * v.y + z * v.z; }

  [[nodiscard]] friend bool operator==(const Frame&, const Frame&) noexcept = default;
};

}  // namespace glint

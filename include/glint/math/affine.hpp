// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <span>

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/solve.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// GLM's matrix with the layout spelled out, as Vec3 is.
template <std::floating_point T>
using Mat3 = glm::mat<3, 3, T, glm::packed_highp>;

/// An affine map p ↦ linear · p + translation; the default is the identity. `a * b` applies b first.
///
/// Rays and boxes: geometry/transform.hpp.
template <std::floating_point T>
struct Affine {
  Mat3<T> linear{T(1)};  ///< columns are the images of the axes
  Vec3<T> translation{T(0)};

  [[nodiscard]] static Affine translate(const Vec3<T>& by) noexcept { return {.translation = by}; }

  [[nodiscard]] static Affine scale(const Vec3<T>& factors) noexcept {
    return {.linear = {factors.x, 0, 0, 0, factors.y, 0, 0, 0, factors.z}};
  }

  /// A right-handed turn about an axis of any length through the origin.
  ///
  /// Requires: axis ≠ 0.
  [[nodiscard]] static Affine rotate(const Vec3<T>& axis, T angle_radians) noexcept {
    const Frame<T> frame = Frame<T>::around(glm::normalize(axis));
    const T c = std::cos(angle_radians);
    const T s = std::sin(angle_radians);
    const auto turned = [&](const Vec3<T>& v) {
      const Vec3<T> w = frame.to_local(v);
      return frame.to_world({c * w.x - s * w.y, s * w.x + c * w.y, w.z});
    };
    return {.linear = {turned({1, 0, 0}), turned({0, 1, 0}), turned({0, 0, 1})}};
  }

  /// From the space of a camera at the origin that looks along −z, with x to its right and y up, to the world where
  /// it stands at `eye` and looks at `target`. Where `up` is along the view, any up will do.
  ///
  /// Requires: eye ≠ target.
  [[nodiscard]] static Affine look_at(const Vec3<T>& eye, const Vec3<T>& target, const Vec3<T>& up) noexcept {
    const Vec3<T> back = glm::normalize(eye - target);
    const Frame<T> frame = Frame<T>::from_normal_and_tangent(back, glm::cross(up, back));
    return {.linear = {frame.x, frame.y, frame.z}, .translation = eye};
  }

  /// From the 16 numbers of a 4 × 4 matrix, row by row, acting on column vectors: translation at 3, 7 and 11.
  ///
  /// Errors: none where the last row is not 0 0 0 1, since that is no affine map.
  [[nodiscard]] static std::optional<Affine> from_row_major(std::span<const T, 16> m) noexcept {
    if (!(m[12] == T(0) && m[13] == T(0) && m[14] == T(0) && m[15] == T(1))) return std::nullopt;
    return Affine{.linear = {m[0], m[4], m[8], m[1], m[5], m[9], m[2], m[6], m[10]},
                  .translation = {m[3], m[7], m[11]}};
  }

  [[nodiscard]] Vec3<T> point(const Vec3<T>& p) const noexcept { return linear * p + translation; }
  [[nodiscard]] Vec3<T> vector(const Vec3<T>& v) const noexcept { return linear * v; }

  /// The transpose of the linear part on a vector: the inverse's takes normals from here to there, but for length.
  [[nodiscard]] Vec3<T> transposed_vector(const Vec3<T>& v) const noexcept { return v * linear; }

  [[nodiscard]] friend Affine operator*(const Affine& a, const Affine& b) noexcept {
    return {.linear = a.linear * b.linear, .translation = a.point(b.translation)};
  }
  [[nodiscard]] friend bool operator==(const Affine&, const Affine&) noexcept = default;
};

namespace detail {

/// The power of two that brings the largest entry to [0.5, 1): scaling by it rounds nothing.
template <std::floating_point T>
[[nodiscard]] T binary_scale(const Mat3<T>& m) noexcept {
  const T largest = std::max(
      {max_component(abs(Vec3<T>(m[0]))), max_component(abs(Vec3<T>(m[1]))), max_component(abs(Vec3<T>(m[2])))});
  if (!(largest > T(0)) || !std::isfinite(largest)) return T(1);
  int exponent = 0;
  std::frexp(largest, &exponent);
  return std::ldexp(T(1), -exponent);
}

}  // namespace detail

/// The map that undoes this one.
///
/// Errors: none where the linear part flattens space, as far as rounding lets one tell, or is not finite.
/// Cost:   nine accurate 2 × 2 determinants: once a placed object, not once a ray.
template <std::floating_point T>
[[nodiscard]] std::optional<Affine<T>> inverse(const Affine<T>& affine) noexcept {
  const T scale = detail::binary_scale(affine.linear);
  const Mat3<T> m = affine.linear * scale;
  const Vec3<T> yz = accurate_cross<T>(m[1], m[2]);
  const Vec3<T> zx = accurate_cross<T>(m[2], m[0]);
  const Vec3<T> xy = accurate_cross<T>(m[0], m[1]);
  const T determinant = glm::dot(Vec3<T>(m[0]), yz);
  const T rounding = rounding_bound<T>(6) * glm::dot(abs(Vec3<T>(m[0])), abs(yz));
  if (!(std::abs(determinant) > rounding)) return std::nullopt;
  const Mat3<T> cofactors{yz, zx, xy};
  Affine<T> result{.linear = glm::transpose(cofactors) * (scale / determinant)};
  result.translation = -(result.linear * affine.translation);
  const bool finite = is_finite<T>(result.linear[0]) && is_finite<T>(result.linear[1]) &&
                      is_finite<T>(result.linear[2]) && is_finite(result.translation);
  return finite ? std::optional(result) : std::nullopt;
}

/// A normal carried along, unit length; it stays on the side it was on, under mirror images too.
///
/// Requires: `to_local` is the inverse of the map that carries it.
template <std::floating_point T>
[[nodiscard]] Vec3<T> transform_normal(const Affine<T>& to_local, const Vec3<T>& normal) noexcept {
  return glm::normalize(to_local.transposed_vector(normal));
}

}  // namespace glint

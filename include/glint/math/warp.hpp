// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

/// Maps from the unit square to the shapes that a renderer samples, with the densities they give.
///
/// Every map is continuous and keeps ratios of areas, so that well spread points stay well spread. Those onto parts of
/// the sphere go through the disk, and thus share its one short evaluation of sine and cosine.
namespace glint {

/// Sine and cosine of one small angle.
template <std::floating_point T>
struct SinCos {
  T sin = 0;
  T cos = 1;
};

namespace detail {

/// How many terms beyond the first the series of sine and cosine need up to π/4.
template <std::floating_point T>
inline constexpr int series_terms = std::numeric_limits<T>::digits <= 24 ? 4 : 8;

/// 1 / (n (n + 1)): the ratio of neighboring terms of those series, at n.
template <std::floating_point T>
inline constexpr auto series_ratios = [] {
  std::array<T, 2 * series_terms<T> + 1> ratios{};
  for (int n = 1; n <= 2 * series_terms<T>; ++n) ratios[static_cast<std::size_t>(n)] = T(1) / T(n * (n + 1));
  return ratios;
}();

}  // namespace detail

/// Sine and cosine without range reduction: short enough to be inlined, where the standard library's are calls.
///
/// Requires: |angle| ≤ π/4.
/// Ensures:  within two units in the last place: the first term left out is below half of one.
template <std::floating_point T>
[[nodiscard]] constexpr SinCos<T> sin_cos_within_eighth_turn(T angle) noexcept {
  const T square = angle * angle;
  T sin = 1;
  T cos = 1;
  for (std::size_t n = 2 * detail::series_terms<T>; n > 0; n -= 2) {  // Horner: 1 − x²/(2·3) (1 − x²/(4·5) (1 − …
    sin = T(1) - square * detail::series_ratios<T>[n] * sin;
    cos = T(1) - square * detail::series_ratios<T>[n - 1] * cos;
  }
  return {angle * sin, cos};
}

/// (y, x) where the condition holds, else (x, y). Spelled on the bits: as a branch, half of the guesses would be wrong.
template <std::floating_point T>
[[nodiscard]] constexpr Vec2<T> swapped_if(bool condition, const Vec2<T>& v) noexcept {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
  const Bits x = std::bit_cast<Bits>(v.x);
  const Bits y = std::bit_cast<Bits>(v.y);
  const Bits change = (x ^ y) & (Bits(0) - Bits(condition));
  return {std::bit_cast<T>(x ^ change), std::bit_cast<T>(y ^ change)};
}

/// A point of the unit disk and its squared distance from the center, which is known without rounding noise.
template <std::floating_point T>
struct DiskPoint {
  Vec2<T> position{T(0)};
  T radius_squared = 0;
};

/// Square rings onto circles of equal area.
///
/// Shapes:   uv in [0, 1]²; the middle of the square is the center of the disk.
/// Ensures:  radius_squared ≤ 1.
/// Source:   Shirley, Chiu, "A Low Distortion Map Between Disk and Square", JGT 2(3), 1997; signed radii as suggested
///           by Cline spare half of its cases.
template <std::floating_point T>
[[nodiscard]] constexpr DiskPoint<T> concentric_disk_point(const Vec2<T>& uv) noexcept {
  const Vec2<T> signed_uv = uv * T(2) - T(1);
  const bool steep = signed_uv.y * signed_uv.y >= signed_uv.x * signed_uv.x;
  const Vec2<T> ring = swapped_if(steep, signed_uv);  // x: the signed radius; y: the way along an eighth of the ring
  const T angle = ring.x == T(0) ? T(0) : pi<T> / T(4) * (ring.y / ring.x);
  const auto [sin, cos] = sin_cos_within_eighth_turn(angle);
  return {swapped_if(steep, Vec2<T>{ring.x * cos, ring.x * sin}), ring.x * ring.x};
}

/// Uniform on the unit disk.
template <std::floating_point T>
[[nodiscard]] constexpr Vec2<T> concentric_disk(const Vec2<T>& uv) noexcept {
  return concentric_disk_point(uv).position;
}

template <std::floating_point T>
[[nodiscard]] constexpr T concentric_disk_pdf() noexcept {
  return inv_pi<T>;
}

/// The uv that `concentric_disk` maps to a point.
template <std::floating_point T>
[[nodiscard]] Vec2<T> concentric_disk_inverse(const Vec2<T>& point) noexcept {
  const bool along_x = std::abs(point.x) > std::abs(point.y);
  const T major = along_x ? point.x : point.y;
  if (major == T(0)) return Vec2<T>{T(0.5)};
  const T minor = along_x ? point.y : point.x;
  const T radius = std::copysign(std::hypot(major, minor), major);
  const T other = radius * (T(4) * inv_pi<T> * std::atan(minor / major));
  const Vec2<T> square = along_x ? Vec2<T>{radius, other} : Vec2<T>{other, radius};
  return square * T(0.5) + T(0.5);
}

/// A direction around +z with density cos θ / π: a point of the disk lifted to the hemisphere.
///
/// Ensures:  z ≥ 0; zero, with density zero, on the rim of the square.
/// Source:   Malley's method; Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section A.5.3.
template <std::floating_point T>
[[nodiscard]] Vec3<T> cosine_hemisphere(const Vec2<T>& uv) noexcept {
  const DiskPoint<T> disk = concentric_disk_point(uv);
  return {disk.position.x, disk.position.y, std::sqrt(T(1) - disk.radius_squared)};
}

/// Units:    1/sr.
template <std::floating_point T>
[[nodiscard]] constexpr T cosine_hemisphere_pdf(T cos_theta) noexcept {
  return cos_theta > T(0) ? cos_theta * inv_pi<T> : T(0);
}

/// 1 − cos θ from sin² θ, without the cancellation that the difference has at small angles.
///
/// Requires: 0 ≤ sin² θ ≤ 1, θ ≤ π/2.
template <std::floating_point T>
[[nodiscard]] T one_minus_cos(T sin_squared) noexcept {
  return sin_squared / (T(1) + std::sqrt(T(1) - sin_squared));
}

/// A uniform direction of the cone around +z. The hemisphere is the cone of extent 1, the sphere that of extent 2.
///
/// The cap of the sphere is the disk bent by Lambert's map, which keeps areas. Directions stay unit vectors to a few
/// roundings, and well spread, for cones of any angle: the cosine, which a small angle does not change, is not used.
///
/// Shapes:   extent = 1 − cos θ_max; from sin² θ_max by `one_minus_cos`.
/// Requires: 0 ≤ extent ≤ 2.
/// Source:   Lambert, "Anmerkungen und Zusätze zur Entwerfung der Land- und Himmelscharten" (1772), section 101.
template <std::floating_point T>
[[nodiscard]] Vec3<T> uniform_cone(const Vec2<T>& uv, T extent) noexcept {
  const DiskPoint<T> disk = concentric_disk_point(uv);
  const T height = disk.radius_squared * extent;  // 1 − cos θ
  const T scale = std::sqrt(extent * (T(2) - height));
  return {disk.position.x * scale, disk.position.y * scale, T(1) - height};
}

/// Units:    1/sr.
/// Requires: extent > 0.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_cone_pdf(T extent) noexcept {
  return T(0.5) * inv_pi<T> / extent;
}

/// A uniform direction with z ≥ 0.
template <std::floating_point T>
[[nodiscard]] Vec3<T> uniform_hemisphere(const Vec2<T>& uv) noexcept {
  return uniform_cone(uv, T(1));
}

/// Units:    1/sr.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_hemisphere_pdf() noexcept {
  return T(0.5) * inv_pi<T>;
}

/// A uniform direction.
template <std::floating_point T>
[[nodiscard]] Vec3<T> uniform_sphere(const Vec2<T>& uv) noexcept {
  return uniform_cone(uv, T(2));
}

/// Units:    1/sr.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_sphere_pdf() noexcept {
  return T(0.25) * inv_pi<T>;
}

/// A uniform point of a triangle, as the weights of its vertices 1 and 2 (those of a Hit): the square is folded along
/// its diagonal. No root, and less distortion than the usual map by one.
///
/// Ensures:  both weights ≥ 0, their sum ≤ 1.
/// Source:   Heitz, "A Low-Distortion Map Between Triangle and Square", 2019.
template <std::floating_point T>
[[nodiscard]] constexpr Vec2<T> uniform_triangle(const Vec2<T>& uv) noexcept {
  const bool above = uv.y > uv.x;
  const T half = T(0.5) * (above ? uv.x : uv.y);
  return above ? Vec2<T>{half, uv.y - half} : Vec2<T>{uv.x - half, half};
}

/// Units:    1 / the unit of area.
/// Requires: area > 0.
template <std::floating_point T>
[[nodiscard]] constexpr T uniform_triangle_pdf(T area) noexcept {
  return T(1) / area;
}

/// The uv that `uniform_triangle` maps to a pair of weights.
template <std::floating_point T>
[[nodiscard]] constexpr Vec2<T> uniform_triangle_inverse(const Vec2<T>& weights) noexcept {
  const bool above = weights.y > weights.x;
  const T sum = weights.x + weights.y;
  return above ? Vec2<T>{T(2) * weights.x, sum} : Vec2<T>{sum, T(2) * weights.y};
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

/// What a smooth interface does to light: where it goes, and how much of it.
///
/// In this header eta is always the index of the side that the given direction is on, over the index of the other side.
namespace glint {

/// The mirror direction: wo turned half around the normal.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3<T> reflect(const Vec3<T>& wo, const Vec3<T>& normal) noexcept {
  return normal * (T(2) * (wo.x * normal.x + wo.y * normal.y + wo.z * normal.z)) - wo;
}

/// The cosine between the refracted direction and the normal's opposite; nothing where all light is reflected.
///
/// Shapes:   eta = index on the given direction's side / index on the other side.
/// Errors:   the critical angle itself, and any NaN, count as total internal reflection.
template <std::floating_point T>
[[nodiscard]] std::optional<T> refracted_cos(T sin_squared, T eta) noexcept {
  const T transmitted = eta * eta * sin_squared;
  if (!(transmitted < T(1))) return std::nullopt;
  return std::sqrt(T(1) - transmitted);
}

/// The direction on the other side of a smooth interface; nothing where all light is reflected. Unlike GLM's function
/// of this name, both directions point away from the surface.
///
/// Shapes:   eta = index on wo's side / index on the other side.
/// Requires: unit vectors, wo on the normal's side.
/// Errors:   the critical angle itself counts as total internal reflection.
/// Source:   Snell's law.
template <std::floating_point T>
[[nodiscard]] std::optional<Vec3<T>> refract(const Vec3<T>& wo, const Vec3<T>& normal, T eta) noexcept {
  const T cos_o = glm::dot(wo, normal);
  const auto cos_i = refracted_cos(std::max(T(0), T(1) - cos_o * cos_o), eta);
  if (!cos_i) return std::nullopt;
  return normal * (eta * cos_o - *cos_i) - wo * eta;
}

/// The share of unpolarized light that a dielectric interface reflects, given the cosines on both sides.
///
/// Shapes:   eta = index on the side of cos_o / index on the side of cos_i.
/// Requires: cosines related by Snell's law, not both zero.
/// Source:   Born, Wolf, Principles of Optics (1999), section 1.5.2.
template <std::floating_point T>
[[nodiscard]] constexpr T fresnel_dielectric(T cos_o, T cos_i, T eta) noexcept {
  const T perpendicular = (eta * cos_o - cos_i) / (eta * cos_o + cos_i);
  const T parallel = (cos_o - eta * cos_i) / (cos_o + eta * cos_i);
  return T(0.5) * (perpendicular * perpendicular + parallel * parallel);
}

/// The share of unpolarized light that a dielectric interface reflects; one beyond the critical angle.
///
/// Shapes:   cos_o = |wo · normal|; eta = index on wo's side / index on the other side.
template <std::floating_point T>
[[nodiscard]] T fresnel_dielectric(T cos_o, T eta) noexcept {
  const auto cos_i = refracted_cos(std::max(T(0), T(1) - cos_o * cos_o), eta);
  return cos_i ? fresnel_dielectric(cos_o, *cos_i, eta) : T(1);
}

/// The share of unpolarized light that a conductor reflects: exact, for the index eta + i k.
///
/// Shapes:   cos_o = wo · normal; eta and k of the conductor, relative to the index outside.
/// Requires: 0 ≤ cos_o ≤ 1; eta > 0, k ≥ 0.
/// Source:   Born, Wolf, Principles of Optics (1999), section 14.4.1, in the squares of the two amplitudes.
template <std::floating_point T>
[[nodiscard]] T fresnel_conductor(T cos_o, T eta, T k) noexcept {
  if (!(cos_o > T(0))) return T(1);
  const T cos_squared = cos_o * cos_o;
  const T sin_squared = T(1) - cos_squared;
  const T real = eta * eta - k * k - sin_squared;                              // (a + i b)² = (eta + i k)² − sin²,
  const T modulus = std::sqrt(real * real + T(4) * eta * eta * k * k);         // a² + b²
  const T cross = cos_o * std::sqrt(std::max(T(0), T(2) * (modulus + real)));  // 2 a cos
  const T sum = modulus + cos_squared;
  const T perpendicular = (sum - cross) / (sum + cross);
  const T sum_parallel = modulus * cos_squared + sin_squared * sin_squared;
  const T cross_parallel = cross * sin_squared;
  const T parallel = perpendicular * (sum_parallel - cross_parallel) / (sum_parallel + cross_parallel);
  return T(0.5) * (perpendicular + parallel);
}

/// The same, channel by channel.
[[nodiscard]] inline Rgb fresnel_conductor(float cos_o, const Rgb& eta, const Rgb& k) noexcept {
  return {fresnel_conductor(cos_o, eta.r, k.r), fresnel_conductor(cos_o, eta.g, k.g),
          fresnel_conductor(cos_o, eta.b, k.b)};
}

/// An approximation of either, from the share reflected at normal incidence.
///
/// Shapes:   a number or an Rgb.
/// Source:   Schlick, "An Inexpensive BRDF Model for Physically-Based Rendering", CGF 13(3), 1994, equation 24.
template <typename Reflectance, std::floating_point T>
[[nodiscard]] constexpr Reflectance fresnel_schlick(T cos_o, const Reflectance& at_normal) noexcept {
  const T m = T(1) - cos_o;
  const T m2 = m * m;
  return at_normal + (Reflectance(T(1)) - at_normal) * (m2 * m2 * m);
}

}  // namespace glint

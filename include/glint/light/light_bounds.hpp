// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/core/one_of.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Where lights stand and where they shine to: in directions at most θo + θe from the axis, for the normals of their
/// surfaces are within θo of it, and light leaves those within θe.
///
/// Units: intensity is the luminance of W/sr in the direction where it is largest.
struct LightBounds {
  Aabb<float> box{};
  Vec3<float> axis{0.0F, 0.0F, 1.0F};  ///< unit length
  float cos_theta_o = -1;
  float cos_theta_e = 0;  ///< not negative
  float intensity = 0;

  [[nodiscard]] friend bool operator==(const LightBounds&, const LightBounds&) noexcept = default;
};

namespace detail {

/// The narrowest cone around two, as axis and cosine. Cones that together look everywhere have the cosine −1.
inline void widen_cone(LightBounds& a, const LightBounds& b) noexcept {
  if (a.cos_theta_o <= -1) return;
  const float theta_a = std::acos(std::clamp(a.cos_theta_o, -1.0F, 1.0F));
  const float theta_b = std::acos(std::clamp(b.cos_theta_o, -1.0F, 1.0F));
  const float between = std::atan2(glm::length(glm::cross(a.axis, b.axis)), glm::dot(a.axis, b.axis));
  if (std::min(between + theta_b, pi<float>) <= theta_a) return;
  if (std::min(between + theta_a, pi<float>) <= theta_b) {
    a.axis = b.axis;
    a.cos_theta_o = b.cos_theta_o;
    return;
  }
  const float theta = 0.5F * (theta_a + between + theta_b);
  const float turn = theta - theta_a;
  const Vec3<float> axis = a.axis * std::sin(between - turn) + b.axis * std::sin(turn);
  const float squared = length_squared(axis);
  const bool known = theta < pi<float> && squared > 1e-12F;  // the plane to turn in, unless the axes are opposite
  if (known) a.axis = axis / std::sqrt(squared);
  a.cos_theta_o = known ? std::max(-1.0F, std::cos(theta) - rounding_bound<float>(8)) : -1.0F;
}

}  // namespace detail

/// The bounds of both. Those without intensity bound nothing.
///
/// Source: Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018, 4.1.
[[nodiscard]] inline LightBounds join(LightBounds a, const LightBounds& b) noexcept {
  if (!(a.intensity > 0)) return b;
  if (!(b.intensity > 0)) return a;
  a.box = join(a.box, b.box);
  a.cos_theta_e = std::min(a.cos_theta_e, b.cos_theta_e);
  a.intensity += b.intensity;
  detail::widen_cone(a, b);
  return a;
}

/// A light that stands somewhere, and says so: `LightBounds light_bounds() const`.
template <typename L>
concept BoundedLight = Light<L> && requires(const L& light) {
  { light.light_bounds() } -> std::same_as<LightBounds>;
};

/// The bounds of any light; nothing where it has none, as those at infinity.
template <typename L>
[[nodiscard]] std::optional<LightBounds> light_bounds(const L& light) {
  if constexpr (BoundedLight<L>) return light.light_bounds();
  return std::nullopt;
}
template <typename... Ts>
[[nodiscard]] std::optional<LightBounds> light_bounds(const OneOf<Ts...>& light) {
  return light.visit([](const auto& x) { return light_bounds(x); });
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <glint/color/rgb.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Light arriving at a point from a direction that a light has chosen.
struct LightSample {
  Vec3<float> wi{0.0F, 0.0F, 1.0F};  ///< unit length, toward the light
  float distance = infinity<float>;  ///< to the light, scene units; infinite for lights at infinity
  Rgb radiance{};                    ///< along −wi; for a delta light, its irradiance on a facing surface
  float pdf = 0;                     ///< 1/sr; 1 for a delta light
  bool is_delta = false;             ///< no other strategy can find this direction
  /// Where a shadow ray ends: the point on the light, moved off its surface. Of no meaning where distance is infinite.
  Vec3<float> target{0.0F};
  Vec3<float> normal{0.0F};  ///< of the light's surface there, unit length; zero where the light has none
};

/// A source of light. What every light answers:
///
///     std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& u) const;  // no visibility test
///     Rgb power(const Aabb<float>& scene) const;      // watts, about right: it only steers how often it is chosen
///
/// A light that stands on surfaces also answers, for rays that find it by themselves,
///
///     Rgb emission(const Surface& at, const Vec3<float>& wo) const;             // radiance leaving `at` toward wo
///     float pdf(const Vec3<float>& from, const Surface& at) const;              // 1/sr, of sample() choosing `at`
///
/// and a light at infinity
///
///     Rgb background(const Vec3<float>& direction) const;                       // radiance a leaving ray meets
///     float pdf(const Vec3<float>& direction) const;                            // 1/sr, of sample() choosing it
///
/// A light whose samples are all alike, whatever the random numbers, has a `static constexpr bool is_delta = true`, so
/// that none are drawn for it.
///
/// Where it stands and shines to (BoundedLight, light_bounds.hpp), and rays that leave it (EmittingLight,
/// emission.hpp), are questions that a light may answer too: for the choice among many lights, and for tracing light
/// from its source.
///
/// Laws: testing/light_laws.hpp.
template <typename L>
concept Light = requires(const L& light, const Vec3<float>& from, const Vec2<float>& u, const Aabb<float>& scene) {
  { light.sample(from, u) } -> std::same_as<std::optional<LightSample>>;
  { light.power(scene) } -> std::same_as<Rgb>;
};

template <typename L>
concept SurfaceLight = Light<L> && requires(const L& light, const Surface& at, const Vec3<float>& w) {
  { light.emission(at, w) } -> std::same_as<Rgb>;
  { light.pdf(w, at) } -> std::same_as<float>;
};

template <typename L>
concept InfiniteLight = Light<L> && requires(const L& light, const Vec3<float>& w) {
  { light.background(w) } -> std::same_as<Rgb>;
  { light.pdf(w) } -> std::same_as<float>;
};

template <Light L>
[[nodiscard]] constexpr bool is_delta(const L& /*light*/) noexcept {
  if constexpr (requires { L::is_delta; }) return L::is_delta;
  return false;
}
template <typename... Ts>
[[nodiscard]] constexpr bool is_delta(const OneOf<Ts...>& light) noexcept {
  return light.visit([](const auto& x) { return is_delta(x); });
}

/// Whether a light is met by rays that leave the scene.
template <Light L>
[[nodiscard]] constexpr bool is_infinite(const L& /*light*/) noexcept {
  return InfiniteLight<L>;
}
template <typename... Ts>
[[nodiscard]] constexpr bool is_infinite(const OneOf<Ts...>& light) noexcept {
  return light.visit([](const auto& x) { return is_infinite(x); });
}

/// The four optional questions, asked of any light: the answer is zero where the light has none.
template <typename L>
[[nodiscard]] Rgb emission(const L& light, const Surface& at, const Vec3<float>& wo) {
  if constexpr (SurfaceLight<L>) return light.emission(at, wo);
  return {};
}
template <typename L>
[[nodiscard]] float surface_pdf(const L& light, const Vec3<float>& from, const Surface& at) {
  if constexpr (SurfaceLight<L>) return light.pdf(from, at);
  return 0;
}
template <typename L>
[[nodiscard]] Rgb background(const L& light, const Vec3<float>& direction) {
  if constexpr (InfiniteLight<L>) return light.background(direction);
  return {};
}
template <typename L>
[[nodiscard]] float background_pdf(const L& light, const Vec3<float>& direction) {
  if constexpr (InfiniteLight<L>) return light.pdf(direction);
  return 0;
}

template <typename... Ts>
[[nodiscard]] Rgb emission(const OneOf<Ts...>& light, const Surface& at, const Vec3<float>& wo) {
  return light.visit([&](const auto& x) { return emission(x, at, wo); });
}
template <typename... Ts>
[[nodiscard]] float surface_pdf(const OneOf<Ts...>& light, const Vec3<float>& from, const Surface& at) {
  return light.visit([&](const auto& x) { return surface_pdf(x, from, at); });
}
template <typename... Ts>
[[nodiscard]] Rgb background(const OneOf<Ts...>& light, const Vec3<float>& direction) {
  return light.visit([&](const auto& x) { return background(x, direction); });
}
template <typename... Ts>
[[nodiscard]] float background_pdf(const OneOf<Ts...>& light, const Vec3<float>& direction) {
  return light.visit([&](const auto& x) { return background_pdf(x, direction); });
}

}  // namespace glint

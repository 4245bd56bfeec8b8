// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

/// Light on its way from the light: what tracing paths from lights starts with.
namespace glint {

/// The densities of a ray that leaves a light. Where no other ray could have the same position, or direction, the
/// density is the delta distribution's, written 1.
struct EmissionPdf {
  float position = 0;   ///< per unit area, over the surface that the ray leaves
  float direction = 0;  ///< 1/sr

  [[nodiscard]] friend bool operator==(const EmissionPdf&, const EmissionPdf&) noexcept = default;
};

/// A ray that leaves a light.
///
/// The flux it stands for is radiance · |normal · direction| / (pdf.position · pdf.direction): the same for all lights,
/// since those without a surface have normal = direction.
struct EmittedRay {
  Ray<float> ray{};                      ///< direction of unit length
  Rgb radiance{};                        ///< intensity if the position is delta, irradiance if the direction is
  Vec3<float> normal{0.0F, 0.0F, 1.0F};  ///< of the surface that the ray leaves
  EmissionPdf pdf{};
  bool is_delta_position = false;
  bool is_delta_direction = false;
};

/// A light that can be asked for rays that leave it. `at` is where they do; its normal, and for lights that are points
/// or infinitely far away all of it, may be of no meaning.
///
///     std::optional<EmittedRay> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction,
///                                    const Aabb<float>& scene) const;
///     EmissionPdf emission_pdf(const Surface& at, const Vec3<float>& direction, const Aabb<float>& scene) const;
///
/// If its rays leave a surface, its samples say that surface's normal (LightSample).
///
/// Laws: testing/light_laws.hpp: the mean flux of the rays is power(scene).
template <typename L>
concept EmittingLight = Light<L> &&
    requires(const L& light, const Vec2<float>& u, const Aabb<float>& scene, const Surface& at, const Vec3<float>& w) {
  { light.emit(u, u, scene) } -> std::same_as<std::optional<EmittedRay>>;
  { light.emission_pdf(at, w, scene) } -> std::same_as<EmissionPdf>;
};

/// The two questions, asked of any light: nothing and zero where it has no answer.
template <typename L>
[[nodiscard]] std::optional<EmittedRay> emit(const L& light, const Vec2<float>& u_position,
                                             const Vec2<float>& u_direction, const Aabb<float>& scene) {
  if constexpr (EmittingLight<L>) return light.emit(u_position, u_direction, scene);
  return std::nullopt;
}
template <typename L>
[[nodiscard]] EmissionPdf emission_pdf(const L& light, const Surface& at, const Vec3<float>& direction,
                                       const Aabb<float>& scene) {
  if constexpr (EmittingLight<L>) return light.emission_pdf(at, direction, scene);
  return {};
}
template <typename... Ts>
[[nodiscard]] std::optional<EmittedRay> emit(const OneOf<Ts...>& light, const Vec2<float>& u_position,
                                             const Vec2<float>& u_direction, const Aabb<float>& scene) {
  return light.visit([&](const auto& x) { return emit(x, u_position, u_direction, scene); });
}
template <typename... Ts>
[[nodiscard]] EmissionPdf emission_pdf(const OneOf<Ts...>& light, const Surface& at, const Vec3<float>& direction,
                                       const Aabb<float>& scene) {
  return light.visit([&](const auto& x) { return emission_pdf(x, at, direction, scene); });
}

/// The disk around a scene that faces a direction: what light from infinity falls through.
struct SceneDisk {
  Vec3<float> center{0.0F};
  float radius = 0;

  explicit SceneDisk(const Aabb<float>& scene) noexcept {
    if (is_empty(scene)) return;
    center = centroid(scene);
    radius = 0.5F * glm::length(extent(scene));
  }

  /// The density of a point of it. Zero where the scene has no extent.
  [[nodiscard]] float pdf() const noexcept { return radius > 0 ? 1 / (pi<float> * radius * radius) : 0; }

  /// A ray toward the scene, from before it.
  ///
  /// Requires: |direction| = 1.
  [[nodiscard]] Ray<float> ray(const Vec3<float>& direction, const Vec2<float>& u) const noexcept {
    const Frame<float> frame = Frame<float>::around(direction);
    const Vec2<float> point = concentric_disk(u) * radius;
    return {.origin = center + (frame.x * point.x + frame.y * point.y - direction * radius), .direction = direction};
  }
};

}  // namespace glint

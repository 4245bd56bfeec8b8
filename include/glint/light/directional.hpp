// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// Parallel light from infinitely far away, as from the sun.
///
/// Units:    irradiance on a surface that faces the light, W/m².
/// Requires: |direction| > 0; it is where the light travels to.
struct DirectionalLight {
  static constexpr bool is_delta = true;

  Vec3<float> direction{0.0F, -1.0F, 0.0F};
  Rgb irradiance{1};

  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& /*from*/,
                                                  const Vec2<float>& /*u*/) const noexcept {
    return LightSample{.wi = -glm::normalize(direction),
                       .distance = infinity<float>,
                       .radiance = irradiance,
                       .pdf = 1,
                       .is_delta = true};
  }

  /// What falls on the disk around the scene.
  [[nodiscard]] Rgb power(const Aabb<float>& scene) const noexcept {
    return irradiance * (pi<float> * 0.25F * length_squared(is_empty(scene) ? Vec3<float>(0) : extent(scene)));
  }

  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& u_position, const Vec2<float>& /*u_direction*/,
                                               const Aabb<float>& scene) const noexcept {
    const SceneDisk disk(scene);
    if (!(disk.radius > 0)) return std::nullopt;
    const Vec3<float> out = glm::normalize(direction);
    return EmittedRay{.ray = disk.ray(out, u_position),
                      .radiance = irradiance,
                      .normal = out,
                      .pdf = {disk.pdf(), 1},
                      .is_delta_direction = true};
  }
  [[nodiscard]] static EmissionPdf emission_pdf(const Surface& /*at*/, const Vec3<float>& /*direction*/,
                                                const Aabb<float>& scene) noexcept {
    return {SceneDisk(scene).pdf(), 1};
  }

  [[nodiscard]] friend bool operator==(const DirectionalLight&, const DirectionalLight&) noexcept = default;
};

static_assert(EmittingLight<DirectionalLight>);

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include <glint/light/concepts.hpp>
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

  [[nodiscard]] friend bool operator==(const DirectionalLight&, const DirectionalLight&) noexcept = default;
};

static_assert(Light<DirectionalLight>);

}  // namespace glint

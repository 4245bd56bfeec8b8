// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
#include <glint/light/light_bounds.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// A point that shines alike in all directions.
///
/// Units: intensity in watts a steradian; 4π of it is the flux.
struct PointLight {
  static constexpr bool is_delta = true;

  Vec3<float> position{0.0F};
  Rgb intensity{1};

  /// The light that gives off so many watts altogether.
  [[nodiscard]] static PointLight from_flux(const Vec3<float>& position, const Rgb& flux) noexcept {
    return {position, flux * (0.25F * inv_pi<float>)};
  }

  /// Nothing where `from` is the light itself.
  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& /*u*/) const noexcept {
    const Vec3<float> to_light = position - from;
    const float squared = length_squared(to_light);
    if (!(squared > 0)) return std::nullopt;
    const float distance = std::sqrt(squared);
    return LightSample{to_light / distance, distance, intensity * (1 / squared), 1, true, position};
  }

  [[nodiscard]] Rgb power(const Aabb<float>& /*scene*/) const noexcept { return intensity * (4 * pi<float>); }

  [[nodiscard]] LightBounds light_bounds() const noexcept {
    return {.box = {position, position}, .intensity = luminance(intensity)};
  }

  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& /*u_position*/, const Vec2<float>& u_direction,
                                               const Aabb<float>& /*scene*/) const noexcept {
    const Vec3<float> direction = uniform_sphere(u_direction);
    return EmittedRay{.ray = {.origin = position, .direction = direction},
                      .radiance = intensity,
                      .normal = direction,
                      .pdf = {1, uniform_sphere_pdf<float>()},
                      .is_delta_position = true};
  }
  [[nodiscard]] static EmissionPdf emission_pdf(const Surface& /*at*/, const Vec3<float>& /*direction*/,
                                                const Aabb<float>& /*scene*/) noexcept {
    return {1, uniform_sphere_pdf<float>()};
  }

  [[nodiscard]] friend bool operator==(const PointLight&, const PointLight&) noexcept = default;
};

static_assert(BoundedLight<PointLight> && EmittingLight<PointLight>);

}  // namespace glint

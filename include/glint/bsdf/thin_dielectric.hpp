// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A pane of glass, or a bubble's skin, as one surface: it mirrors or lets light pass straight on, alike from both
/// sides.
///
/// Light that bounces within the pane leaves on either side in the end: with Fresnel's share R at each face and
/// T = 1 − R, the pane reflects R + T R T + T R³ T + … = R + T² R / (1 − R²) = 2 R / (1 + R). Radiance is not scaled:
/// both sides are in one medium. u chooses between the two directions with the reflected share as the chance.
///
/// Shapes:   eta = index of the pane / index around it. reflectance and transmittance multiply the two shares: one for
///           clear glass.
/// Requires: eta > 0.
/// Source:   Pharr, Jakob, Humphreys, Physically Based Rendering (2023), section 9.5.1.
struct ThinDielectric {
  Rgb reflectance{1.0F};
  Rgb transmittance{1.0F};
  float eta = 1.5F;

  [[nodiscard]] static constexpr Rgb evaluate(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept {
    return {};
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept { return 0; }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u,
                                                 const Vec2<float>& /*uv*/) const noexcept {
    const float face = fresnel_dielectric(std::abs(wo.z), 1.0F / eta);
    const float pane = 2.0F * face / (1.0F + face);
    if (u < pane) return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance, pane, Lobe::Specular};
    return BsdfSample{-wo, transmittance, 1.0F - pane, Lobe::Specular};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return true; }

  [[nodiscard]] friend constexpr bool operator==(const ThinDielectric&, const ThinDielectric&) noexcept = default;
};

static_assert(Bsdf<ThinDielectric>);

}  // namespace glint

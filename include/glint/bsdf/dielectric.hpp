// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A smooth interface between two media, glass and air say: it reflects Fresnel's share and refracts the rest.
///
/// Transmitted radiance is scaled by the squared index ratio (wo's side over wi's side), as radiance is in physics: it
/// cancels when light leaves the body again. u chooses between the two directions with Fresnel's share as the chance.
///
/// Shapes:   eta = index inside / index outside; z points outside. reflectance and transmittance multiply Fresnel's
///           shares: one for clear glass.
/// Requires: eta > 0.
struct Dielectric {
  Rgb reflectance{1.0F};
  Rgb transmittance{1.0F};
  float eta = 1.5F;

  [[nodiscard]] static constexpr Rgb evaluate(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept {
    return {};
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept { return 0; }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u,
                                                 const Vec2<float>& /*uv*/) const noexcept {
    const bool outside = wo.z > 0.0F;
    const float ratio = outside ? 1.0F / eta : eta;
    const auto cos_i = refracted_cos(wo.x * wo.x + wo.y * wo.y, ratio);
    const float reflected = cos_i ? fresnel_dielectric(std::abs(wo.z), *cos_i, ratio) : 1.0F;
    if (u < reflected) return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance, reflected, Lobe::Specular};
    const Vec3<float> wi{-ratio * wo.x, -ratio * wo.y, outside ? -*cos_i : *cos_i};
    return BsdfSample{wi, transmittance * (ratio * ratio), 1.0F - reflected, Lobe::Specular, 1.0F / (ratio * ratio)};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return true; }

  [[nodiscard]] friend constexpr bool operator==(const Dielectric&, const Dielectric&) noexcept = default;
};

static_assert(Bsdf<Dielectric>);

}  // namespace glint

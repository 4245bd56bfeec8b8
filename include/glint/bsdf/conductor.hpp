// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A smooth metal, on the normal's side; black from behind. The default is aluminum.
///
/// Shapes:   eta + i k is the metal's index relative to the one outside; reflectance multiplies Fresnel's.
/// Requires: eta > 0, k ≥ 0.
/// Source:   aluminum at 650, 550 and 450 nm: Smith, Shiles, Inokuti in Palik, Handbook of Optical Constants of Solids
///           (1985).
struct Conductor {
  Rgb reflectance{1.0F};
  Rgb eta{1.47F, 0.96F, 0.62F};
  Rgb k{7.79F, 6.69F, 5.47F};

  [[nodiscard]] static constexpr Rgb evaluate(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept {
    return {};
  }

  [[nodiscard]] static constexpr float pdf(const Vec3<float>& /*wo*/, const Vec3<float>& /*wi*/) noexcept { return 0; }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                 const Vec2<float>& /*uv*/) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance * fresnel_conductor(wo.z, eta, k), 1.0F, Lobe::Specular};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return true; }

  [[nodiscard]] friend constexpr bool operator==(const Conductor&, const Conductor&) noexcept = default;
};

static_assert(Bsdf<Conductor>);

}  // namespace glint

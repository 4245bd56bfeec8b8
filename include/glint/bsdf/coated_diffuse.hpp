// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

namespace detail {

/// The share of diffuse light that a smooth dielectric lets in: one minus the mean of Fresnel's reflectance.
///
/// Requires: 1 ≤ eta.
/// Ensures:  within 5e-5 for 1.03 ≤ eta ≤ 3, a polynomial fitted to the integral.
[[nodiscard]] constexpr float mean_transmittance(float eta) noexcept {
  const float r = (eta - 1.0F) / (eta + 1.0F);
  const float high = -9.01666F + r * (22.1984681F + r * (-30.2852715F + r * 16.7626947F));
  return 0.999392429F + r * (-0.580700378F + r * (1.75589723F + r * high));
}

}  // namespace detail

/// A smooth coat, of varnish say, over a diffuse base, as on plastic or glazed tiles; on the normal's side, black from
/// behind.
///
/// What the coat does not reflect enters, is scattered by the base, and leaves or is sent back to the base by the
/// coat's inner side, which happens any number of times: colors become deeper. A base that reflects everything loses
/// nothing.
///
/// u chooses between the two parts by their shares of the light.
///
/// Shapes:   reflectance is the base's, as if it were bare; eta = index of the coat / index outside.
/// Requires: 0 ≤ reflectance ≤ 1; 1.03 ≤ eta ≤ 3.
/// Source:   Wolff, "Diffuse-Reflectance Model for Smooth Dielectric Surfaces", JOSA A 11(11), 1994; the inner side
///           reflects 1 − (1 − F) / eta² of diffuse light, F the outer side's mean: Duntley, "The Optical Properties of
///           Diffusing Materials", JOSA 32(2), 1942.
struct CoatedDiffuse {
  Rgb reflectance{0.5F};
  float eta = 1.5F;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    return base() * (transmitted(wo.z) * transmitted(wi.z) * inv_pi<float> * wi.z);
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return 0.0F;
    return (1.0F - coat_chance(1.0F - transmitted(wo.z), base())) * inv_pi<float> * wi.z;
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const Rgb below = base();
    const float mirrored = fresnel_dielectric(wo.z, 1.0F / eta);
    const float chance = coat_chance(mirrored, below);
    if (u < chance) return BsdfSample{{-wo.x, -wo.y, wo.z}, mirrored / chance, chance, Lobe::Specular};
    const Vec3<float> wi = cosine_hemisphere(uv);
    if (!(wi.z > 0.0F)) return std::nullopt;
    const float rest = 1.0F - chance;
    return BsdfSample{wi, below * ((1.0F - mirrored) * transmitted(wi.z) / rest), rest * inv_pi<float> * wi.z,
                      Lobe::Diffuse};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const CoatedDiffuse&, const CoatedDiffuse&) noexcept = default;

 private:
  [[nodiscard]] float transmitted(float cos) const noexcept { return 1.0F - fresnel_dielectric(cos, 1.0F / eta); }

  /// Of the light that has entered, what the base scatters before it has crossed the coat again, over the share of
  /// diffuse light that crosses it: ρ / (eta² (1 − ρ F)), where eta² (1 − F) is the share that diffuse light has to
  /// enter.
  [[nodiscard]] Rgb base() const noexcept {
    const float squared = eta * eta;
    return reflectance / (Rgb{squared} - reflectance * (squared - detail::mean_transmittance(eta)));
  }

  [[nodiscard]] float coat_chance(float mirrored, const Rgb& below) const noexcept {
    return mirrored / (mirrored + (1.0F - mirrored) * max_component(below) * detail::mean_transmittance(eta));
  }
};

static_assert(Bsdf<CoatedDiffuse>);

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/microfacet_albedo.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// A rough reflector of single scattering that knows what its facets reflect on the mean.
template <typename B>
concept CompensableBsdf = Bsdf<B> && requires(const B& bsdf) {
  DirectionalAlbedo{bsdf.distribution};
  { bsdf.mean_reflectance() } -> std::same_as<Rgb>;
};

/// A rough metal that returns the light which its facets hide, as more bounces would: rough metal stays as bright as
/// smooth metal, and its color gets deeper.
///
/// The lobe added is diffuse at both ends, (1 − E(wo)) (1 − E(wi)) / (π (1 − mean E)), E the directional albedo of
/// facets that reflect everything. It goes both ways alike.
///
/// Ensures:  facets that reflect everything lose nothing, within 0.01 for isotropic roughness of 0.05 ≤ alpha ≤ 1;
///           anisotropic ones may lose or gain some, since the tables know only their mean roughness.
/// Source:   Kulla, Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH course Physically Based
/// Shading
///           in Theory and Practice, 2017.
template <CompensableBsdf B>
struct Compensated : B {
  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    const DirectionalAlbedo albedo{this->distribution};
    return B::evaluate(wo, wi) + added(albedo, albedo.missing(wo.z), wi.z);
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return 0.0F;
    const float missing = DirectionalAlbedo{this->distribution}.missing(wo.z);
    return (1.0F - missing) * B::pdf(wo, wi) + missing * inv_pi<float> * wi.z;
  }

  /// The added lobe is drawn as often as it carries light where facets reflect everything.
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const DirectionalAlbedo albedo{this->distribution};
    const float missing = albedo.missing(wo.z);
    const float rest = 1.0F - missing;
    if (u < missing) {
      const Vec3<float> wi = cosine_hemisphere(uv);
      if (!(wi.z > 0.0F)) return std::nullopt;
      const float pdf = rest * B::pdf(wo, wi) + missing * inv_pi<float> * wi.z;
      return BsdfSample{wi, (B::evaluate(wo, wi) + added(albedo, missing, wi.z)) / pdf, pdf, Lobe::Diffuse};
    }
    auto result = B::sample(wo, std::min((u - missing) / rest, one_minus_epsilon<float>), uv);
    if (!result) return result;
    const float pdf = rest * result->pdf + missing * inv_pi<float> * result->wi.z;
    result->weight = (result->weight * result->pdf + added(albedo, missing, result->wi.z)) / pdf;
    result->pdf = pdf;
    return result;
  }

  [[nodiscard]] friend constexpr bool operator==(const Compensated&, const Compensated&) noexcept = default;

 private:
  using Albedo = DirectionalAlbedo<decltype(B::distribution)>;

  /// Each bounce but the first is off facets seen from everywhere, and leaves with the chance of the mean albedo.
  [[nodiscard]] Rgb added(const Albedo& albedo, float missing_o, float cos_i) const noexcept {
    const float lost = albedo.mean_missing();
    if (!(lost > 0.0F)) return {};
    const Rgb f = this->mean_reflectance();
    return f * f / (Rgb{1.0F} - f * lost) *
           ((1.0F - lost) * missing_o * albedo.missing(cos_i) / lost * inv_pi<float> * cos_i);
  }
};

template <CompensableBsdf B>
Compensated(B) -> Compensated<B>;

static_assert(Bsdf<Compensated<RoughConductor<Ggx>>>);

}  // namespace glint

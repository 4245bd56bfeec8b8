// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A rough metal, on the normal's side: single scattering by facets that are smooth metal; black from behind. The
/// default is aluminum.
///
/// f = F D G₂ / (4 cos θo cos θi) with Smith's G₂ for correlated heights. Light that facets hide is lost, as it is in
/// all models of single scattering.
///
/// Shapes:   eta + i k is the metal's index relative to the one outside; reflectance multiplies Fresnel's.
/// Requires: eta > 0, k ≥ 0; the distribution's.
/// Source:   Cook, Torrance, "A Reflectance Model for Computer Graphics", TOG 1(1), 1982; sampling of visible normals:
///           Heitz, d'Eon, CGF 33(4), 2014.
template <MicrofacetDistribution Distribution = Beckmann>
struct RoughConductor {
  Rgb reflectance{1.0F};
  Distribution distribution{};
  Rgb eta{1.47F, 0.96F, 0.62F};
  Rgb k{7.79F, 6.69F, 5.47F};

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    const Vec3<float> m = glm::normalize(wo + wi);
    const float area_o = distribution.projected_area(wo);
    return fresnel(glm::dot(wo, m)) *
           (distribution.density(m) / (4.0F * area_o) * shared_visibility(distribution, wo, wi, area_o));
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return 0.0F;
    return distribution.density(glm::normalize(wo + wi)) / (4.0F * distribution.projected_area(wo));
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float /*u*/,
                                                 const Vec2<float>& uv) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const Vec3<float> m = distribution.sample_visible(wo, uv);
    const Vec3<float> wi = reflect(wo, m);
    if (!(wi.z > 0.0F)) return std::nullopt;
    const float area_o = distribution.projected_area(wo);
    return BsdfSample{wi, fresnel(glm::dot(wo, m)) * shared_visibility(distribution, wo, wi, area_o),
                      distribution.density(m) / (4.0F * area_o), Lobe::Glossy};
  }

  /// The mean of what a facet reflects over the hemisphere, by the cosine: Fresnel's reflectance where it is close to
  /// that mean, within 0.011 for metals.
  [[nodiscard]] Rgb mean_reflectance() const noexcept { return fresnel(0.54F); }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const RoughConductor&, const RoughConductor&) noexcept = default;

 private:
  [[nodiscard]] Rgb fresnel(float cos_o) const noexcept { return reflectance * fresnel_conductor(cos_o, eta, k); }
};

static_assert(Bsdf<RoughConductor<Beckmann>> && Bsdf<RoughConductor<Ggx>>);

}  // namespace glint

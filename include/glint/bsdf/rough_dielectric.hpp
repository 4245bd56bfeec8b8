// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A rough interface between two media, frosted glass say: facets that are smooth dielectrics reflect and refract.
///
/// Reflection is F D G₂ / (4 cos θo cos θi) with Smith's G₂ for correlated heights. Refraction follows Walter et al.,
/// equation 21, hidden from each side independently. Light that facets hide is lost, as it is in all models of single
/// scattering.
///
/// Transmitted radiance is scaled by the squared index ratio (wo's side over wi's side), as `Dielectric` does. u
/// chooses between the two directions with the facet's Fresnel share as the chance.
///
/// Shapes:   eta = index inside / index outside; z points outside. reflectance and transmittance multiply the two
///           parts: one for clear glass.
/// Requires: eta > 0; the distribution's. An eta of one lets light pass straight on, unscattered; within about 1e-3 of
///           one, single precision blurs what is refracted.
/// Source:   Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007; sampling of visible
///           normals: Heitz, d'Eon, CGF 33(4), 2014.
template <MicrofacetDistribution Distribution = Beckmann>
struct RoughDielectric {
  Rgb reflectance{1.0F};
  Rgb transmittance{1.0F};
  Distribution distribution{};
  float eta = 1.5F;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    const From from = seen_from(wo);
    const Vec3<float> i = turned(wi, from);
    const float pdf = density(from, i);
    return pdf > 0.0F ? weight(from, i) * pdf : Rgb{};
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    const From from = seen_from(wo);
    return density(from, turned(wi, from));
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const noexcept {
    const From from = seen_from(wo);
    if (!(from.o.z > 0.0F)) return std::nullopt;
    const Vec3<float> m = distribution.sample_visible(from.o, uv);
    const float cos_o = glm::dot(from.o, m);
    if (!(cos_o > 0.0F)) return std::nullopt;
    const auto cos_i = refracted_cos(std::max(0.0F, 1.0F - cos_o * cos_o), from.ratio);
    const float share = cos_i ? fresnel_dielectric(cos_o, *cos_i, from.ratio) : 1.0F;
    if (u < share) {
      const Vec3<float> i = reflect(from.o, m);
      return i.z > 0.0F ? scattered(from, i, share * 0.25F * facets(from, m)) : std::nullopt;
    }
    const float length = (from.ratio - 1.0F) * (from.ratio + 1.0F) / (from.ratio * cos_o + *cos_i);
    if (length == 0.0F) return BsdfSample{-wo, transmittance, 1.0F, Lobe::Specular};
    const Vec3<float> i = m * length - from.o * from.ratio;
    if (!(i.z < 0.0F)) return std::nullopt;
    return scattered(from, i, (1.0F - share) * facets(from, m) * cos_o * *cos_i / (length * length));
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const RoughDielectric&, const RoughDielectric&) noexcept = default;

 private:
  /// wo's point of view: the surface turned over where need be, so that wo is above.
  struct From {
    Vec3<float> o{0.0F, 0.0F, 1.0F};
    float side = 1;   ///< −1: turned over
    float ratio = 1;  ///< index above / index below
    float area = 1;   ///< the distribution's projected_area(o)
  };

  [[nodiscard]] From seen_from(const Vec3<float>& wo) const noexcept {
    const bool outside = wo.z > 0.0F;
    const Vec3<float> o{wo.x, wo.y, std::abs(wo.z)};
    return {o, outside ? 1.0F : -1.0F, outside ? 1.0F / eta : eta, distribution.projected_area(o)};
  }

  [[nodiscard]] static Vec3<float> turned(const Vec3<float>& w, const From& from) noexcept {
    return {w.x, w.y, w.z * from.side};
  }

  /// The density of visible normals over the cosine between o and m.
  [[nodiscard]] float facets(const From& from, const Vec3<float>& m) const noexcept {
    return distribution.density(m) / from.area;
  }

  [[nodiscard]] std::optional<BsdfSample> scattered(const From& from, const Vec3<float>& i, float pdf) const noexcept {
    return BsdfSample{turned(i, from), weight(from, i), pdf, Lobe::Glossy};
  }

  [[nodiscard]] float density(const From& from, const Vec3<float>& i) const noexcept {
    if (!(from.o.z > 0.0F)) return 0.0F;
    if (i.z > 0.0F) return reflected_density(from, i);
    return i.z < 0.0F ? refracted_density(from, i) : 0.0F;
  }

  [[nodiscard]] float reflected_density(const From& from, const Vec3<float>& i) const noexcept {
    const Vec3<float> m = glm::normalize(from.o + i);
    return 0.25F * fresnel_dielectric(glm::dot(from.o, m), from.ratio) * facets(from, m);
  }

  /// Snell's law makes ratio · o + i a multiple of the facet's normal. Fresnel's share depends on the ratio of the two
  /// cosines alone, so that they need not be divided by its length.
  [[nodiscard]] float refracted_density(const From& from, const Vec3<float>& i) const noexcept {
    const float sign = from.ratio < 1.0F ? -1.0F : 1.0F;  // the normal points to the thinner medium, or away from it
    const float cosine = glm::dot(from.o, i);
    const float toward_o = sign * (from.ratio + cosine);
    const float toward_i = -sign * (1.0F + from.ratio * cosine);
    if (!(toward_o > 0.0F && toward_i > 0.0F)) return 0.0F;
    const Vec3<float> normal = (from.o * from.ratio + i) * sign;
    const float squared = length_squared(normal);
    const float share = fresnel_dielectric(toward_o, toward_i, from.ratio);
    return (1.0F - share) * facets(from, normal / std::sqrt(squared)) * toward_o * toward_i / (squared * squared);
  }

  /// What is left of the light that a visible facet sends toward i.
  [[nodiscard]] Rgb weight(const From& from, const Vec3<float>& i) const noexcept {
    if (i.z > 0.0F) return reflectance * shared_visibility(distribution, from.o, i, from.area);
    return transmittance * (from.ratio * from.ratio * masking(distribution, {i.x, i.y, -i.z}));
  }
};

static_assert(Bsdf<RoughDielectric<Beckmann>> && Bsdf<RoughDielectric<Ggx>>);

}  // namespace glint

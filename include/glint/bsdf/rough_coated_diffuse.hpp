// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/fresnel.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/microfacet_albedo.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// A rough coat over a diffuse base, as on plastic or eggshell paint; on the normal's side, black from behind.
///
/// The coat reflects as facets of a smooth dielectric do, once. What it does not reflect enters, what its facets hide
/// included; it is scattered by the base, and leaves or is sent back to the base by the coat's inner side, any number
/// of times.
///
/// u chooses between the two parts by their shares of the light.
///
/// Shapes:   reflectance is the base's, as if it were bare; eta = index of the coat / index outside.
/// Requires: 0 ≤ reflectance ≤ 1; 1.03 ≤ eta ≤ 3; the distribution's.
/// Ensures:  for isotropic roughness of 0.05 ≤ alpha ≤ 1, a base that reflects everything gains at most 0.01, and loses
///           at most 0.01 where eta is 1.5, for which the tables are made, and 0.05 for 1.3 ≤ eta ≤ 2.5; anisotropic
///           coats may lose or gain some, since the tables know only their mean roughness.
/// Source:   the base, seen through albedos: Kulla, Conty, "Revisiting Physically Based Shading at Imageworks",
///           SIGGRAPH course Physically Based Shading in Theory and Practice, 2017; the inner side, as in
///           `CoatedDiffuse`: Duntley, "The Optical Properties of Diffusing Materials", JOSA 32(2), 1942.
template <MicrofacetDistribution Distribution = Ggx>
struct RoughCoatedDiffuse {
  Rgb reflectance{0.5F};
  Distribution distribution{};
  float eta = 1.5F;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    return value(seen_from(wo), wo, wi, facets(wo, wi));
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return 0.0F;
    return density(seen_from(wo).coat_chance, wi, facets(wo, wi));
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const From from = seen_from(wo);
    const bool coat = u < from.coat_chance;
    const Vec3<float> wi = coat ? reflect(wo, distribution.sample_visible(wo, uv)) : cosine_hemisphere(uv);
    if (!(wi.z > 0.0F)) return std::nullopt;
    const Facets there = facets(wo, wi);
    const float pdf = density(from.coat_chance, wi, there);
    if (!(pdf > 0.0F)) return std::nullopt;
    return BsdfSample{wi, value(from, wo, wi, there) / pdf, pdf, coat ? Lobe::Glossy : Lobe::Diffuse};
  }

  /// About what share of the light from a direction is reflected: that of the brightest channel.
  [[nodiscard]] float albedo(float cos_o) const noexcept {
    const From from = seen_from({0.0F, 0.0F, cos_o});
    return 1.0F - from.entering + from.entering * max_component(from.base) * from.mean_entering;
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const RoughCoatedDiffuse&,
                                                 const RoughCoatedDiffuse&) noexcept = default;

 private:
  /// All that depends on wo alone.
  struct From {
    DirectionalAlbedo<Distribution> albedo;
    float at_normal;      ///< what facets reflect straight on
    float entering;       ///< the share of the light from wo that passes the coat
    float mean_entering;  ///< of light from everywhere
    Rgb base;             ///< what leaves the base, over what enters and over `mean_entering`
    float coat_chance;
  };

  /// The facets that mirror wo into wi.
  struct Facets {
    float cosine;   ///< between them and either
    float area_o;   ///< the distribution's projected_area(wo)
    float density;  ///< of wi, where the coat is sampled
  };

  [[nodiscard]] From seen_from(const Vec3<float>& wo) const noexcept {
    const float root = (eta - 1.0F) / (eta + 1.0F);
    const float at_normal = root * root;
    const DirectionalAlbedo albedo{distribution};
    const float reflected = albedo.dielectric(wo.z, at_normal);
    const float mean_entering = 1.0F - albedo.mean_dielectric(at_normal);
    const float squared = eta * eta;
    const Rgb base = reflectance / (Rgb{squared} - reflectance * (squared - mean_entering));
    const float below = (1.0F - reflected) * max_component(base) * mean_entering;
    return {albedo, at_normal, 1.0F - reflected, mean_entering, base, reflected / (reflected + below)};
  }

  [[nodiscard]] Facets facets(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    const Vec3<float> m = glm::normalize(wo + wi);
    const float area_o = distribution.projected_area(wo);
    return {glm::dot(wo, m), area_o, distribution.density(m) / (4.0F * area_o)};
  }

  [[nodiscard]] Rgb value(const From& from, const Vec3<float>& wo, const Vec3<float>& wi,
                          const Facets& there) const noexcept {
    const float coat = fresnel_dielectric(there.cosine, 1.0F / eta) * there.density *
                       shared_visibility(distribution, wo, wi, there.area_o);
    const float through = from.entering * (1.0F - from.albedo.dielectric(wi.z, from.at_normal));
    return Rgb{coat} + from.base * (through * inv_pi<float> * wi.z);
  }

  [[nodiscard]] static float density(float coat_chance, const Vec3<float>& wi, const Facets& there) noexcept {
    return coat_chance * there.density + (1.0F - coat_chance) * inv_pi<float> * wi.z;
  }
};

static_assert(Bsdf<RoughCoatedDiffuse<Beckmann>> && Bsdf<RoughCoatedDiffuse<Ggx>>);

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glint/bsdf/compensated.hpp>
#include <glint/bsdf/concepts.hpp>
#include <glint/bsdf/metals.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/microfacet_albedo.hpp>
#include <glint/bsdf/rough_coated_diffuse.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/bsdf/sheen.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// One BSDF for most surfaces, by a few numbers that artists know: a base that is opaque, glass or metal, or between
/// them, under a clear coat, under fuzz.
///
/// - opaque: `RoughCoatedDiffuse`, a diffuse base of the base color under a rough surface
/// - glass: `RoughDielectric`; each crossing takes the root of the base color
/// - metal: `Compensated<RoughConductor>`, of the base color where it is seen straight on
/// - the coat: facets of index 1.5, `coat` of the surface is covered
/// - the fuzz: `Sheen`
///
/// A layer takes from what is below it the larger of the two shares that it reflects of light from wo and from wi. Coat
/// and fuzz are on the outside; glass seen from inside shows none. Opaque parts and metal are black from inside.
///
/// u chooses among the five by about the light that each reflects.
///
/// Units:    all but eta from 0 to 1. alpha = roughness²; anisotropy draws the highlights of glass and metal out along
///           the tangent, alpha_y / alpha_x = 1 − 0.9 anisotropy; on opaque parts it would feign light.
///           eta = index inside / index outside. sheen_tint 1: the fuzz has the base color's hue, 0: none.
/// Requires: 1.03 ≤ eta ≤ 3. alpha below 1e-3 counts as 1e-3.
/// Ensures:  light goes both ways alike. No more leaves than arrives, but for the errors of tables: 0.01, and
///           up to 0.05 as anisotropy reaches one.
/// Source:   parameters after Burley, "Physically Based Shading at Disney" (2012) and "Extending the Disney BRDF to a
///           BSDF with Integrated Subsurface Scattering" (2015), SIGGRAPH courses, and the OpenPBR Surface
///           specification 1.1 (2024). Deviations: exact Fresnel terms in place of Schlick's, and no specular tint; the
///           diffuse base is OpenPBR's, Lambert's under a surface, not Burley's; the coat is like the other facets, not
///           of Burley's tails; the fuzz is that of Estevez and Kulla; nothing scatters below the surface, nothing is
///           thin. The layers' larger share is Enterprise PBR's (Dassault Systèmes, 2021), which unlike OpenPBR's goes
///           both ways.
struct Principled {
  Rgb base_color{0.8F};
  float metallic = 0;
  float roughness = 0.5F;
  float anisotropy = 0;
  float eta = 1.5F;
  float transmission = 0;
  float coat = 0;
  float coat_roughness = 0.1F;
  float sheen = 0;
  float sheen_roughness = 0.5F;
  float sheen_tint = 0;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    Rgb sum;
    for_each_base([&](float share, const auto& part) { sum += part.evaluate(wo, wi) * share; });
    if (wo.z < 0.0F && wi.z < 0.0F) return sum;
    if (coat > 0.0F) {
      sum *= 1.0F - coat * std::max(coat_albedo(wo), coat_albedo(wi));
      sum += coat_part().evaluate(wo, wi) * coat;
    }
    if (sheen > 0.0F) {
      const Sheen fuzz = sheen_part();
      sum *= 1.0F - sheen * std::max(fuzz.albedo(std::abs(wo.z)), fuzz.albedo(std::abs(wi.z)));
      sum += fuzz.evaluate(wo, wi) * sheen;
    }
    return sum;
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    return density(chances(wo), wo, wi);
  }

  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const noexcept {
    const Chances chance = chances(wo);
    auto result = drawn(chance, wo, u, uv);
    if (!result || is_one_part()) return result;
    result->pdf = density(chance, wo, result->wi);
    if (!(result->pdf > 0.0F)) return std::nullopt;
    result->weight = evaluate(wo, result->wi) / result->pdf;
    return result;
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const Principled&, const Principled&) noexcept = default;

 private:
  static constexpr float coat_eta = 1.5F;
  static constexpr float coat_at_normal = 0.04F;

  /// With what chance each part is sampled.
  struct Chances {
    float sheen = 0;
    float coat = 0;
    float opaque = 0;
    float glass = 0;
    float metal = 0;
  };

  [[nodiscard]] float opaque_share() const noexcept { return (1.0F - metallic) * (1.0F - transmission); }
  [[nodiscard]] float glass_share() const noexcept { return (1.0F - metallic) * transmission; }

  /// Whether it is one of the base's parts and nothing else.
  [[nodiscard]] bool is_one_part() const noexcept {
    return !(coat > 0.0F || sheen > 0.0F) && (opaque_share() == 1.0F || glass_share() == 1.0F || metallic == 1.0F);
  }

  [[nodiscard]] static float alpha(float of_roughness) noexcept { return std::max(of_roughness * of_roughness, 1e-3F); }

  [[nodiscard]] static Ggx even_facets(float of_roughness) noexcept {
    const float mean = alpha(of_roughness);
    return {mean, mean};
  }

  [[nodiscard]] Ggx facets() const noexcept {
    const float aspect = std::sqrt(1.0F - 0.9F * anisotropy);
    const float mean = alpha(roughness);
    return {mean / aspect, std::max(mean * aspect, 1e-3F)};
  }

  [[nodiscard]] RoughCoatedDiffuse<Ggx> opaque_part() const noexcept {
    return {base_color, even_facets(roughness), eta};
  }

  [[nodiscard]] RoughDielectric<Ggx> glass_part() const noexcept {
    const Rgb root{std::sqrt(base_color.r), std::sqrt(base_color.g), std::sqrt(base_color.b)};
    return {Rgb{1.0F}, root, facets(), eta};
  }

  [[nodiscard]] Compensated<RoughConductor<Ggx>> metal_part() const noexcept {
    const Metal metal = metal_of_color(base_color);
    return {{Rgb{1.0F}, facets(), metal.eta, metal.k}};
  }

  /// A conductor that does not conduct is a dielectric that shows no inside.
  [[nodiscard]] RoughConductor<Ggx> coat_part() const noexcept {
    return {Rgb{1.0F}, even_facets(coat_roughness), Rgb{coat_eta}, Rgb{0.0F}};
  }

  [[nodiscard]] float coat_albedo(const Vec3<float>& w) const noexcept {
    return DirectionalAlbedo{even_facets(coat_roughness)}.dielectric(std::abs(w.z), coat_at_normal);
  }

  [[nodiscard]] Sheen sheen_part() const noexcept {
    const float brightest = max_component(base_color);
    const Rgb hue = brightest > 0.0F ? base_color / brightest : Rgb{1.0F};
    return {Rgb{1.0F - sheen_tint} + hue * sheen_tint, sheen_roughness};
  }

  /// Calls f(share of the surface, part) for the parts of the base that are there.
  template <typename F>
  void for_each_base(const F& f) const noexcept {
    if (opaque_share() > 0.0F) f(opaque_share(), opaque_part());
    if (glass_share() > 0.0F) f(glass_share(), glass_part());
    if (metallic > 0.0F) f(metallic, metal_part());
  }

  [[nodiscard]] Chances chances(const Vec3<float>& wo) const noexcept {
    if (!(wo.z > 0.0F)) return {.glass = glass_share() > 0.0F ? 1.0F : 0.0F};
    Chances result{.sheen = sheen > 0.0F ? sheen * sheen_part().albedo(wo.z) : 0.0F,
                   .coat = coat > 0.0F ? coat * coat_albedo(wo) : 0.0F};
    const float below = (1.0F - result.sheen) * (1.0F - result.coat);
    const float brightest = max_component(base_color);
    result.opaque = below * opaque_share() * (0.1F + 0.9F * brightest);
    result.glass = below * glass_share();
    result.metal = below * metallic * (0.1F + 0.9F * brightest);
    const float all = 1.0F / (result.sheen + result.coat + result.opaque + result.glass + result.metal);
    return {result.sheen * all, result.coat * all, result.opaque * all, result.glass * all, result.metal * all};
  }

  [[nodiscard]] float density(const Chances& chance, const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    float sum = chance.sheen * Sheen::pdf(wo, wi);
    if (chance.coat > 0.0F) sum += chance.coat * coat_part().pdf(wo, wi);
    if (chance.opaque > 0.0F) sum += chance.opaque * opaque_part().pdf(wo, wi);
    if (chance.glass > 0.0F) sum += chance.glass * glass_part().pdf(wo, wi);
    if (chance.metal > 0.0F) sum += chance.metal * metal_part().pdf(wo, wi);
    return sum;
  }

  /// A sample of one part. Requires: u < 1.
  [[nodiscard]] std::optional<BsdfSample> drawn(const Chances& chance, const Vec3<float>& wo, float u,
                                                const Vec2<float>& uv) const noexcept {
    const auto takes = [&u](float share) {
      if (u < share) {
        u = std::min(u / share, one_minus_epsilon<float>);
        return true;
      }
      u -= share;
      return false;
    };
    if (takes(chance.opaque)) return opaque_part().sample(wo, u, uv);
    if (takes(chance.metal)) return metal_part().sample(wo, u, uv);
    if (takes(chance.coat)) return coat_part().sample(wo, u, uv);
    if (takes(chance.sheen)) return sheen_part().sample(wo, u, uv);
    if (!(chance.glass > 0.0F)) return std::nullopt;
    return glass_part().sample(wo, std::min(u / chance.glass, one_minus_epsilon<float>), uv);
  }
};

static_assert(Bsdf<Principled>);

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// Rough diffuse reflection, on the normal's side: flatter than Lambert's, as the moon and clay are; black from behind.
///
/// The energy-preserving Oren-Nayar model. Light that the valleys of the surface keep at first is returned after more
/// bounces, so that a reflectance of one loses nothing at any roughness. A roughness of zero is Lambert's reflection.
///
/// In the paper's terms, the share that the first bounce does not return is 1 − E = A r g / π, where
/// g = π/2 − 2/3 − G depends on the angle alone: nothing cancels when all is spelled through g.
///
/// Shapes:   reflectance is that of the facets: light of several bounces is more saturated.
/// Requires: 0 ≤ roughness ≤ 1; 0 ≤ reflectance ≤ 1.
/// Source:   Portsmouth, Kutz, Hill, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025; the
///           single bounce: Fujii's form of Oren, Nayar, "Generalization of Lambert's Reflectance Model", SIGGRAPH
///           1994.
struct OrenNayar {
  Rgb reflectance{0.5F};
  float roughness = 0.5F;

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    if (!(wo.z > 0.0F && wi.z > 0.0F)) return {};
    return scattered(wo, wi) * (inv_pi<float> * wi.z);
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    return wo.z > 0.0F && wi.z > 0.0F ? density(uniform_share(wo.z), wi.z) : 0.0F;
  }

  /// Mostly by the cosine; uniformly for the bright rim that rough surfaces show to grazing eyes.
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const noexcept {
    if (!(wo.z > 0.0F)) return std::nullopt;
    const float uniform = uniform_share(wo.z);
    const Vec3<float> wi = u < uniform ? uniform_hemisphere(uv) : cosine_hemisphere(uv);
    if (!(wi.z > 0.0F)) return std::nullopt;
    const float pdf = density(uniform, wi.z);
    return BsdfSample{wi, scattered(wo, wi) * (inv_pi<float> * wi.z / pdf), pdf, Lobe::Diffuse};
  }

  [[nodiscard]] static constexpr bool is_specular() noexcept { return false; }

  [[nodiscard]] friend constexpr bool operator==(const OrenNayar&, const OrenNayar&) noexcept = default;

 private:
  /// How often a direction is drawn uniformly: fitted to the shares that make the weights vary least.
  [[nodiscard]] float uniform_share(float cos_o) const noexcept {
    const float m = 1.0F - cos_o;
    return 0.7F * roughness * m * m * m;
  }

  [[nodiscard]] static constexpr float density(float uniform, float cos_i) noexcept {
    return inv_pi<float> * (0.5F * uniform + (1.0F - uniform) * cos_i);
  }

  /// g(cos θ), zero at grazing angles. A polynomial stands for the part with the arc cosine,
  /// (π/2 − θ sin θ + cos θ sin² θ / 3) / cos θ, within 5e-5.
  [[nodiscard]] static float kept(float cos) noexcept {
    const float sin = std::sqrt(std::max(0.0F, 1.0F - cos * cos));
    const float smooth = 1.333376F + cos * (0.783219F + cos * (-0.647882F + cos * (0.134393F - cos * 0.0323347F)));
    return cos * (smooth - (2.0F / 3.0F) * (cos + sin) / (1.0F + sin));
  }

  /// π f. The mean of g over the hemisphere, by the cosine, is 6/5 − π/6.
  [[nodiscard]] Rgb scattered(const Vec3<float>& wo, const Vec3<float>& wi) const noexcept {
    constexpr float mean_kept = 1.2F - pi<float> / 6.0F;
    constexpr float tint = 0.5F - 2.0F / 3.0F * inv_pi<float>;
    const float scale = 1.0F / (1.0F + tint * roughness);
    const float s = glm::dot(wo, wi) - wo.z * wi.z;
    const float once = scale * (1.0F + roughness * (s > 0.0F ? s / std::max(wo.z, wi.z) : s));
    const float again = scale * roughness * inv_pi<float>;  // times g: the share that bounces again
    const float mean_again = again * mean_kept;
    const Rgb bounces = reflectance * reflectance * (1.0F - mean_again) / (Rgb{1.0F} - reflectance * mean_again);
    return reflectance * once + bounces * (again / mean_kept * kept(wo.z) * kept(wi.z));
  }
};

static_assert(Bsdf<OrenNayar>);

}  // namespace glint

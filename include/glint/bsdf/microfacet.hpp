// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

#include <glm/geometric.hpp>

#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

/// Statistics of rough surfaces made of tiny mirrors.
///
/// Smith's functions are spelled through one quantity, the area σ(w) that the facets facing a direction w project onto
/// the plane across it, over a unit of the surface. It stays finite where the textbook's Λ = σ / cos θ − 1 does not,
/// and what a BSDF needs becomes short: masking is cos θ / σ, the density of visible normals (w · m)₊ D(m) / σ.
namespace glint {

/// A distribution of facet normals m.
///
/// - `density(m)` is D: the area of facets per unit of surface and of solid angle, 1/sr; zero for m.z ≤ 0.
/// - `projected_area(w)` is σ(w) = ∫ (w · m)₊ D(m) dm, w on the surface's side.
/// - `sample_visible(w, uv)` draws m with the density `visible_density` states.
template <typename D>
concept MicrofacetDistribution = requires(const D& distribution, const Vec3<float>& w, const Vec2<float>& uv) {
  { distribution.density(w) } -> std::same_as<float>;
  { distribution.projected_area(w) } -> std::same_as<float>;
  { distribution.sample_visible(w, uv) } -> std::same_as<Vec3<float>>;
};

/// Smith's Λ: the area of facets in shadow over that of visible ones. Requires: w.z > 0.
template <MicrofacetDistribution D>
[[nodiscard]] float smith_lambda(const D& distribution, const Vec3<float>& w) noexcept {
  return distribution.projected_area(w) / w.z - 1.0F;
}

/// Smith's G₁: the share of facets facing w that others do not hide. Requires: w.z > 0.
template <MicrofacetDistribution D>
[[nodiscard]] float masking(const D& distribution, const Vec3<float>& w) noexcept {
  return w.z / distribution.projected_area(w);
}

/// Smith's G₂ with correlated heights, 1 / (1 + Λ(wo) + Λ(wi)): of facets facing both, the share hidden from neither.
///
/// Deep facets are hidden from both directions more often than chance has it; the product of two G₁ forgets this and
/// loses energy.
///
/// Requires: wo.z > 0, wi.z > 0.
/// Source:   Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 3(2), 2014,
///           equation 99.
template <MicrofacetDistribution D>
[[nodiscard]] float masking_shadowing(const D& distribution, const Vec3<float>& wo, const Vec3<float>& wi) noexcept {
  return 1.0F / (1.0F + smith_lambda(distribution, wo) + smith_lambda(distribution, wi));
}

/// G₂ / G₁(wo), heights correlated: of the facets visible from wo, the share visible from wi too.
///
/// Shapes:   area_o = projected_area(wo), which callers need as well.
/// Requires: wo.z > 0, wi.z > 0.
template <MicrofacetDistribution D>
[[nodiscard]] float shared_visibility(const D& distribution, const Vec3<float>& wo, const Vec3<float>& wi,
                                      float area_o) noexcept {
  const float seen = wi.z * area_o;
  return seen / (seen + wo.z * (distribution.projected_area(wi) - wi.z));
}

/// The density of facet normals seen from w, 1/sr.
template <MicrofacetDistribution D>
[[nodiscard]] float visible_density(const D& distribution, const Vec3<float>& w, const Vec3<float>& m) noexcept {
  return std::max(0.0F, glm::dot(w, m)) * distribution.density(m) / distribution.projected_area(w);
}

/// Trowbridge and Reitz's distribution: the normals of an ellipsoid. Long tails, so highlights with a haze.
///
/// Units:    alpha: roughness along x and along y; Beckmann's of the same alpha has a highlight of like size.
/// Requires: alpha_x, alpha_y > 0; below about 1e-3 single precision blurs the highlight.
/// Source:   Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2; Heitz,
///           JCGT 3(2), 2014, sections 5.3 and 5.4.
struct Ggx {
  float alpha_x = 0.1F;
  float alpha_y = 0.1F;

  [[nodiscard]] float density(const Vec3<float>& m) const noexcept {
    if (!(m.z > 0.0F)) return 0.0F;
    const float x = m.x / alpha_x;
    const float y = m.y / alpha_y;
    const float squared = x * x + y * y + m.z * m.z;
    return inv_pi<float> / (alpha_x * alpha_y * squared * squared);
  }

  [[nodiscard]] float projected_area(const Vec3<float>& w) const noexcept {
    return 0.5F * (w.z + std::sqrt(length_squared(stretched(w))));
  }

  /// Seen in a space where the ellipsoid is a sphere, mirrored directions fill a cap of it uniformly.
  ///
  /// Requires: w.z > 0.
  /// Source:   Dupuy, Benyoub, "Sampling Visible GGX Normals with Spherical Caps", CGF 42(8), 2023.
  [[nodiscard]] Vec3<float> sample_visible(const Vec3<float>& w, const Vec2<float>& uv) const noexcept {
    const Vec3<float> unit = glm::normalize(stretched(w));
    Vec3<float> m = unit + uniform_cone(uv, 1.0F + unit.z);
    m.z = std::max(m.z, 1e-7F);  // on the rim of the cap rounding would lay facets on edge, or leave no direction
    return glm::normalize(stretched(m));
  }

  [[nodiscard]] friend constexpr bool operator==(const Ggx&, const Ggx&) noexcept = default;

 private:
  [[nodiscard]] constexpr Vec3<float> stretched(const Vec3<float>& v) const noexcept {
    return {alpha_x * v.x, alpha_y * v.y, v.z};
  }
};

static_assert(MicrofacetDistribution<Ggx>);

namespace detail {

/// Twice the area that Gaussian slopes below x (density exp(−x²) / √π) project toward a direction of the given cosine
/// and sine: 2 ∫ (cos − t sin) exp(−t²) / √π dt up to x.
///
/// Requires: bell = exp(−x²), which callers need as well.
[[nodiscard]] inline float twice_gaussian_area_below(float x, float bell, float cos, float sin) noexcept {
  return cos * std::erfc(-x) + sin * std::numbers::inv_sqrtpi_v<float> * bell;
}

/// A Gaussian slope as seen along a direction of the given cosine and sine: density in proportion to
/// (cos − x sin)₊ exp(−x²).
///
/// Newton's iteration from the mode: the distribution function is convex before it and concave after it, so each step
/// stays on its side of the answer, and needs no safeguard.
///
/// Requires: cos > 0, sin ≥ 0, cos² + sin² = 1.
/// Cost:     about three steps, each an erfc and an exp.
/// Source:   the density: Heitz, d'Eon, "Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible
///           Normals", CGF 33(4), 2014; inversion by Newton's iteration: Jakob, "An Improved Visible Normal Sampling
///           Routine for the Beckmann Distribution", 2014, who starts from a fit.
[[nodiscard]] inline float visible_gaussian_slope(float u, float cos, float sin) noexcept {
  constexpr float half_sqrt_pi = 0.5F / std::numbers::inv_sqrtpi_v<float>;
  constexpr float lowest = -4.0F;  // with a chance of 1e-8: the rest is left out, or u = 0 would run away
  const float highest = std::min(sin > 0.0F ? cos / sin : -lowest, -lowest);
  const float target = u * twice_gaussian_area_below(highest, std::exp(-highest * highest), cos, sin);
  float x = -sin / (cos + std::sqrt(cos * cos + 2.0F * sin * sin));
  float previous = 0.0F;
  for (int i = 0; i < 16; ++i) {
    const float bell = std::exp(-x * x);
    const float missing = target - twice_gaussian_area_below(x, bell, cos, sin);
    const float step = half_sqrt_pi * missing / ((cos - x * sin) * bell);
    if (!(step * previous >= 0.0F)) break;  // a turn: rounding has the last word
    x = std::clamp(x + step, lowest, highest);
    if (std::abs(step) < 1e-3F) break;  // each step squares the error: the next would be below rounding
    previous = step;
  }
  return x;
}

}  // namespace detail

/// Beckmann's distribution: Gaussian slopes.
///
/// Units:    alpha: root of twice the mean squared slope, along x and along y.
/// Requires: alpha_x, alpha_y > 0; below about 1e-3 single precision blurs the highlight.
/// Source:   Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2; Heitz,
///           JCGT 3(2), 2014, sections 5.2 and 5.4.
struct Beckmann {
  float alpha_x = 0.1F;
  float alpha_y = 0.1F;

  [[nodiscard]] float density(const Vec3<float>& m) const noexcept {
    if (!(m.z > 0.0F)) return 0.0F;
    const float x = m.x / alpha_x;
    const float y = m.y / alpha_y;
    const float z2 = m.z * m.z;
    return inv_pi<float> * std::exp(-(x * x + y * y) / z2) / (alpha_x * alpha_y * z2 * z2);
  }

  [[nodiscard]] float projected_area(const Vec3<float>& w) const noexcept {
    const float sine = std::sqrt(alpha_x * alpha_x * w.x * w.x + alpha_y * alpha_y * w.y * w.y);
    if (!(sine > 0.0F)) return w.z;
    const float x = w.z / sine;
    return 0.5F * detail::twice_gaussian_area_below(x, std::exp(-x * x), w.z, sine);
  }

  /// Slopes along w and across it are independent; w sees only the former foreshortened.
  ///
  /// Requires: w.z > 0.
  [[nodiscard]] Vec3<float> sample_visible(const Vec3<float>& w, const Vec2<float>& uv) const noexcept {
    const Vec3<float> unit = glm::normalize(Vec3<float>{alpha_x * w.x, alpha_y * w.y, w.z});
    const float sine = std::sqrt(unit.x * unit.x + unit.y * unit.y);
    const Vec2<float> along = sine > 0.0F ? Vec2<float>{unit.x / sine, unit.y / sine} : Vec2<float>{1.0F, 0.0F};
    const float a = detail::visible_gaussian_slope(uv.x, unit.z, sine);
    const float b = detail::visible_gaussian_slope(uv.y, 1.0F, 0.0F);
    return glm::normalize(
        Vec3<float>{-alpha_x * (along.x * a - along.y * b), -alpha_y * (along.y * a + along.x * b), 1.0F});
  }

  [[nodiscard]] friend constexpr bool operator==(const Beckmann&, const Beckmann&) noexcept = default;
};

static_assert(MicrofacetDistribution<Beckmann>);

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A BSDF on a surface whose normal is bent, by a normal map say, without black fringes and without gained energy.
///
/// The surface is taken for stairs: facets with the bent normal, joined by upright mirrors, so that it is flat on the
/// whole. Stairs hide each other, and light may meet one mirror, before or after the facet. What would meet a facet
/// twice is lost.
///
/// Requires: a unit normal with z > 0.
/// Source:   Schüssler, Heitz, Hanika, Dachsbacher, "Microfacet-based Normal Mapping for Robust Monte Carlo Path
///           Tracing", TOG 36(6), 2017: mirrors as tangent facets, two bounces; here also for light that passes
///           through.
template <Bsdf B>
class Perturbed {
 public:
  /// A surface that keeps its normal.
  constexpr Perturbed() = default;

  Perturbed(const B& base, const Vec3<float>& normal) noexcept : base_(base) {
    if (normal.x * normal.x + normal.y * normal.y > 1e-10F)
      frame_ = Frame<float>::from_normal_and_tangent(normal, {1.0F, 0.0F, 0.0F});
  }

  [[nodiscard]] const B& base() const noexcept { return base_; }
  [[nodiscard]] const Vec3<float>& normal() const noexcept { return frame_.z; }

  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const Stairs o = seen_from(wo);
    const Stairs i = seen_from(wi);
    if (!(o.height > 0.0F && i.height > 0.0F)) return {};
    Rgb sum = facet_value(wo, wi) * o.facet();
    if (i.side > 0.0F) sum += facet_value(wo, mirrored(wi)) * (o.facet() * i.mirrored());
    if (o.side > 0.0F) sum += facet_value(mirrored(wo), wi) * (1.0F - o.facet());
    return sum * i.visible();
  }

  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const Stairs o = seen_from(wo);
    const Stairs i = seen_from(wi);
    if (!(o.height > 0.0F && i.height > 0.0F)) return 0.0F;
    float sum = facet_pdf(wo, wi) * (o.facet() * i.visible());
    if (i.side > 0.0F) sum += facet_pdf(wo, mirrored(wi)) * (o.facet() * i.mirrored());
    if (o.side > 0.0F) sum += facet_pdf(mirrored(wo), wi) * (1.0F - o.facet());
    return sum;
  }

  /// u chooses between facet and mirror, then a lobe of the base; its low digits, whether a mirror follows.
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const {
    const Stairs o = seen_from(wo);
    if (!(o.height > 0.0F)) return std::nullopt;
    const float facet = o.facet();
    const bool straight = u < facet;
    const float chance = straight ? facet : 1.0F - facet;
    const float rest = std::min((straight ? u : u - facet) / chance, one_minus_epsilon<float>);
    const Vec3<float> from = frame_.to_local(straight ? wo : mirrored(wo));
    if (!(from.z * wo.z > 0.0F)) return std::nullopt;
    auto result = base_.sample(from, rest, uv);
    if (!result) return result;
    Vec3<float> wi = frame_.to_world(result->wi);
    if (!(wi.z * result->wi.z > 0.0F)) return std::nullopt;
    if (result->lobe == Lobe::Specular) {
      result->wi = wi;
      result->weight *= seen_from(wi).visible();
      result->pdf *= chance;
      return result;
    }
    const float digits = 4096.0F * rest;
    if (straight && !(digits - std::floor(digits) < seen_from(wi).visible())) wi = mirrored(wi);
    result->wi = wi;
    result->pdf = pdf(wo, wi);
    if (!(result->pdf > 0.0F)) return std::nullopt;
    result->weight = evaluate(wo, wi) / result->pdf;
    return result;
  }

  [[nodiscard]] constexpr bool is_specular() const { return base_.is_specular(); }

  [[nodiscard]] friend bool operator==(const Perturbed&, const Perturbed&) = default;

 private:
  /// What a direction sees of the stairs, over the area of a facet.
  struct Stairs {
    float height = 0;  ///< the area of the flat whole
    float front = 0;   ///< the facet's
    float side = 0;    ///< the mirror's

    /// The share of the facet in what is seen.
    [[nodiscard]] float facet() const noexcept { return front / (front + side); }
    /// The share that stairs do not hide from each other.
    [[nodiscard]] float visible() const noexcept { return height / (front + side); }
    /// Of the light that leaves a facet so that the mirror turns it into this direction, what meets the mirror.
    [[nodiscard]] float mirrored() const noexcept { return side / (height + side); }
  };

  [[nodiscard]] Stairs seen_from(const Vec3<float>& w) const noexcept {
    const float height = std::abs(w.z) * frame_.z.z;
    const float slope = std::copysign(1.0F, w.z) * (w.x * frame_.z.x + w.y * frame_.z.y);
    return {height, std::max(0.0F, height + slope), std::max(0.0F, -slope)};
  }

  /// Requires: a bent normal.
  [[nodiscard]] Vec3<float> mirrored(const Vec3<float>& w) const noexcept {
    const Vec3<float>& n = frame_.z;
    const float twice = 2.0F * (w.x * n.x + w.y * n.y) / (n.x * n.x + n.y * n.y);
    return {w.x - twice * n.x, w.y - twice * n.y, w.z};
  }

  [[nodiscard]] Rgb facet_value(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const Vec3<float> o = frame_.to_local(wo);
    const Vec3<float> i = frame_.to_local(wi);
    return o.z * wo.z > 0.0F && i.z * wi.z > 0.0F ? base_.evaluate(o, i) : Rgb{};
  }

  [[nodiscard]] float facet_pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    const Vec3<float> o = frame_.to_local(wo);
    const Vec3<float> i = frame_.to_local(wi);
    return o.z * wo.z > 0.0F && i.z * wi.z > 0.0F ? base_.pdf(o, i) : 0.0F;
  }

  B base_{};
  Frame<float> frame_{};
};

}  // namespace glint

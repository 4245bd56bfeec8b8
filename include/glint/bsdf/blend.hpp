// SPDX-License-Identifier: MIT
#pragma once
#include <optional>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// Two BSDFs side by side, too fine a pattern to be seen: a share of the surface is the second one. u chooses between
/// them by that share.
///
/// Requires: 0 ≤ share ≤ 1.
template <Bsdf A, Bsdf B>
struct Blend {
  A first{};
  B second{};
  float share = 0.5F;  ///< of the second

  [[nodiscard]] constexpr Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return first.evaluate(wo, wi) * (1.0F - share) + second.evaluate(wo, wi) * share;
  }

  [[nodiscard]] constexpr float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return first.pdf(wo, wi) * (1.0F - share) + second.pdf(wo, wi) * share;
  }

  [[nodiscard]] constexpr std::optional<BsdfSample> sample(const Vec3<float>& wo, float u,
                                                           const Vec2<float>& uv) const {
    if (u < share) return sampled(second, share, first, wo, u / share, uv);
    const float rest = 1.0F - share;
    return sampled(first, rest, second, wo, (u - share) / rest, uv);
  }

  [[nodiscard]] constexpr bool is_specular() const { return first.is_specular() && second.is_specular(); }

  [[nodiscard]] friend bool operator==(const Blend&, const Blend&) = default;

 private:
  /// A sample of the chosen one; what the other one scatters there is added, unless nothing else leads there.
  template <Bsdf Chosen, Bsdf Other>
  [[nodiscard]] static constexpr std::optional<BsdfSample> sampled(const Chosen& chosen, float chance,
                                                                   const Other& other, const Vec3<float>& wo, float u,
                                                                   const Vec2<float>& uv) {
    auto result = chosen.sample(wo, u < one_minus_epsilon<float> ? u : one_minus_epsilon<float>, uv);
    if (!result) return result;
    const float pdf = result->pdf * chance;
    const float rest = 1.0F - chance;
    if (result->lobe == Lobe::Specular) {
      result->pdf = pdf;
      return result;
    }
    result->pdf = pdf + other.pdf(wo, result->wi) * rest;
    result->weight = (result->weight * pdf + other.evaluate(wo, result->wi) * rest) / result->pdf;
    return result;
  }
};

template <Bsdf A, Bsdf B>
Blend(A, B, float) -> Blend<A, B>;
template <Bsdf A, Bsdf B>
Blend(A, B) -> Blend<A, B>;

}  // namespace glint

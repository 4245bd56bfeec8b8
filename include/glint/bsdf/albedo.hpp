// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/core/one_of.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A BSDF that knows its directional albedo in closed form: `albedo(wo)`.
template <typename B>
concept BsdfWithAlbedo = Bsdf<B> && requires(const B& bsdf, const Vec3<float>& wo) {
  { bsdf.albedo(wo) } -> std::same_as<Rgb>;
};

/// An unbiased estimate of the directional albedo, ∫ f(wo, wi) |cos θi| dωi over all directions and specular lobes: the
/// share of light that a surface scatters toward wo under an even sky. Exact where the BSDF has a closed form; else the
/// weight of one sample, whose expectation it is.
///
/// Shapes:   u in [0, 1), uv in [0, 1)², as for the BSDF's `sample`. A BSDF that scales transmitted radiance by the
///           squared index ratio does so here.
template <Bsdf B>
[[nodiscard]] Rgb estimated_albedo(const B& bsdf, const Vec3<float>& wo, float u, const Vec2<float>& uv) {
  if constexpr (BsdfWithAlbedo<B>) {
    return bsdf.albedo(wo);
  } else {
    const auto sample = bsdf.sample(wo, u, uv);
    return sample ? sample->weight : Rgb{};
  }
}

/// Of the BSDF held.
template <Bsdf... Bs>
[[nodiscard]] Rgb estimated_albedo(const OneOf<Bs...>& bsdf, const Vec3<float>& wo, float u, const Vec2<float>& uv) {
  return bsdf.visit([&](const auto& held) { return estimated_albedo(held, wo, u, uv); });
}

}  // namespace glint

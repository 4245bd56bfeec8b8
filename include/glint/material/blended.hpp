// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include <glint/bsdf/blend.hpp>
#include <glint/color/rgb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/material/concepts.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// Two materials, mixed as a texture says: its luminance, held to [0, 1], is the share of the second.
template <Material A, Material B, ShadingTexture T>
struct Blended {
  A first{};
  B second{};
  T share{};

  [[nodiscard]] Blend<BsdfOf<A>, BsdfOf<B>> bsdf(const Surface& at) const {
    const float there = luminance(color_at(share, at));
    return {bsdf_at(first, at, 0), bsdf_at(second, at, 0), std::min(std::max(0.0F, there), 1.0F)};
  }

  [[nodiscard]] friend bool operator==(const Blended&, const Blended&) = default;
};

template <Material A, Material B, ShadingTexture T>
Blended(A, B, T) -> Blended<A, B, T>;

}  // namespace glint

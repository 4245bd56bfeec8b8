// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include <glint/bsdf/perturbed.hpp>
#include <glint/color/rgb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/material/concepts.hpp>
#include <glint/math/vec.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// A material whose normals follow the slopes of a height texture: its luminance times `scale`, along the normal.
///
/// Slopes are differences between heights one `step` before and one after. ∂position/∂v is taken to be the normal
/// crossed with ∂position/∂u: right where the parametrization is neither stretched nor mirrored.
///
/// Units:    scale: scene units for a luminance of one; step: texture coordinates, about one pixel of the texture.
/// Requires: step > 0.
/// Errors:   surfaces without a parametrization, and slopes that are not finite, are left flat.
/// Cost:     four evaluations of the texture.
/// Source:   Blinn, "Simulation of Wrinkled Surfaces", SIGGRAPH 1978.
template <Material M, Texture T>
struct BumpMapped {
  M base{};
  T height{};
  float scale = 1;
  float step = 1.0F / 1024;

  [[nodiscard]] Perturbed<BsdfOf<M>> bsdf(const Surface& at) const {
    const UvFootprint over = uv_footprint(at);
    const auto height_at = [&](const Vec2<float>& uv) { return luminance(color_at(height, uv, over)); };
    const float rise_u = height_at(at.uv + Vec2<float>{step, 0.0F}) - height_at(at.uv - Vec2<float>{step, 0.0F});
    const float rise_v = height_at(at.uv + Vec2<float>{0.0F, step}) - height_at(at.uv - Vec2<float>{0.0F, step});
    const float slope = -0.5F * scale / (step * std::sqrt(length_squared(at.tangent)));
    const Vec3<float> normal{slope * rise_u, slope * rise_v, 1.0F};
    const bool bent = std::isfinite(length_squared(normal));
    return {bsdf_at(base, at, 0), bent ? normalized(normal) : Vec3<float>{0.0F, 0.0F, 1.0F}};
  }

  [[nodiscard]] friend bool operator==(const BumpMapped&, const BumpMapped&) = default;
};

template <Material M, Texture T>
BumpMapped(M, T, float, float) -> BumpMapped<M, T>;
template <Material M, Texture T>
BumpMapped(M, T, float) -> BumpMapped<M, T>;
template <Material M, Texture T>
BumpMapped(M, T) -> BumpMapped<M, T>;

}  // namespace glint

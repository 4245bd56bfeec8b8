// SPDX-License-Identifier: MIT
#pragma once
#include <glint/bsdf/perturbed.hpp>
#include <glint/color/rgb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/material/concepts.hpp>
#include <glint/math/vec.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// A material whose normals are bent by a texture in tangent space: red goes along ∂position/∂u, green along the normal
/// crossed with it, toward growing v on most surfaces, blue along the normal; each runs from −1 to 1.
///
/// Requires: a texture that is read as it is, not as sRGB.
/// Errors:   normals that do not point up, and surfaces without a parametrization, are left as they are.
template <Material M, Texture T>
struct NormalMapped {
  M base{};
  T normals{};

  [[nodiscard]] Perturbed<BsdfOf<M>> bsdf(const Surface& at) const {
    const Rgb color = color_at(normals, at);
    const Vec3<float> normal{2.0F * color.r - 1.0F, 2.0F * color.g - 1.0F, 2.0F * color.b - 1.0F};
    const bool bent = normal.z > 0.0F && is_finite(normal) && length_squared(at.tangent) > 0.0F;
    return {bsdf_at(base, at, 0), bent ? normalized(normal) : Vec3<float>{0.0F, 0.0F, 1.0F}};
  }

  [[nodiscard]] friend bool operator==(const NormalMapped&, const NormalMapped&) = default;
};

template <Material M, Texture T>
NormalMapped(M, T) -> NormalMapped<M, T>;

}  // namespace glint

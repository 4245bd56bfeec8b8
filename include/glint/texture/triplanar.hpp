// SPDX-License-Identifier: MIT
#pragma once
#include <glint/texture/concepts.hpp>

namespace glint {

/// A texture laid on surfaces from three sides, along the axes of the world: for shapes without texture coordinates.
///
/// Seen along x it lies at (z, y), along y at (x, z), along z at (x, y), and counts as much as the fourth power of the
/// shading normal's component along that axis. By coordinates alone it is the texture itself.
///
/// Units:    scale: texture coordinates a scene unit.
/// Errors:   without a normal, black.
/// Cost:     one lookup for each axis along which the normal has a part.
/// Source:   Geiss, "Generating Complex Procedural Terrains Using the GPU", GPU Gems 3 (2007), section 1.5.
template <Texture T>
struct Triplanar {
  T texture{};
  float scale = 1;

  [[nodiscard]] Rgb evaluate(const Surface& at) const {
    const Vec3<float> squared = at.shading_normal * at.shading_normal;
    const Vec3<float> weight = squared * squared;
    const auto laid_on = [&](auto&& side) {
      const UvFootprint over{scale * side(at.footprint.x), scale * side(at.footprint.y)};
      return color_at(texture, scale * side(at.position), over);
    };
    Rgb sum;
    if (weight.x > 0) sum += weight.x * laid_on([](const Vec3<float>& p) { return Vec2<float>{p.z, p.y}; });
    if (weight.y > 0) sum += weight.y * laid_on([](const Vec3<float>& p) { return Vec2<float>{p.x, p.z}; });
    if (weight.z > 0) sum += weight.z * laid_on([](const Vec3<float>& p) { return Vec2<float>{p.x, p.y}; });
    const float weights = weight.x + weight.y + weight.z;
    return weights > 0 ? sum / weights : Rgb{};
  }

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const { return texture.evaluate(uv); }

  [[nodiscard]] friend bool operator==(const Triplanar&, const Triplanar&) = default;
};

template <Texture T>
Triplanar(T, float) -> Triplanar<T>;
template <Texture T>
Triplanar(T) -> Triplanar<T>;

}  // namespace glint

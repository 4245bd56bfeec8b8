// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/bsdf/concepts.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// A BSDF with a color that a texture can stand for.
template <typename B>
concept ReflectingBsdf = Bsdf<B> && requires(B& bsdf, const Rgb& color) {
  bsdf.reflectance = color;
};

/// A BSDF whose `reflectance` comes from a texture: by the surface where the texture asks for it, else by its
/// coordinates.
template <ReflectingBsdf B, ShadingTexture T>
struct Textured {
  T texture;
  B base{};  ///< everything but the reflectance

  [[nodiscard]] B bsdf(const Surface& at) const {
    B result = base;
    result.reflectance = color_at(texture, at);
    return result;
  }

  [[nodiscard]] friend bool operator==(const Textured&, const Textured&) = default;
};

}  // namespace glint

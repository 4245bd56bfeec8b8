// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <vector>

#include <glint/bsdf/principled.hpp>
#include <glint/color/rgb.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// A `Principled` surface whose color, and any of whose numbers, come from textures: of a number's texture the
/// luminance, held to [0, 1].
template <ShadingTexture T>
struct TexturedPrincipled {
  /// The texture that stands for one of the numbers: {&Principled::roughness, texture}.
  struct Number {
    float Principled::*member = nullptr;
    T texture{};

    [[nodiscard]] friend bool operator==(const Number&, const Number&) = default;
  };

  T base_color{};
  Principled base{};  ///< everything but the base color
  std::vector<Number> numbers{};

  [[nodiscard]] Principled bsdf(const Surface& at) const {
    Principled result = base;
    result.base_color = color_at(base_color, at);
    for (const Number& number : numbers) {
      result.*number.member = std::clamp(luminance(color_at(number.texture, at)), 0.0F, 1.0F);
    }
    return result;
  }

  [[nodiscard]] friend bool operator==(const TexturedPrincipled&, const TexturedPrincipled&) = default;
};

}  // namespace glint

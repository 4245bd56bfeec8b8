// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A color over texture coordinates. v = 0 is the top row of an image.
template <typename T>
concept Texture = requires(const T& texture, const Vec2<float>& uv) {
  { texture.evaluate(uv) } -> std::same_as<Rgb>;
};

}  // namespace glint

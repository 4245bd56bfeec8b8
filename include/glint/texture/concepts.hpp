// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/color/rgb.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A color over texture coordinates. v = 0 is the top row of an image.
template <typename T>
concept Texture = requires(const T& texture, const Vec2<float>& uv) {
  { texture.evaluate(uv) } -> std::same_as<Rgb>;
};

/// A color that depends on more of a surface than its texture coordinates: its position, say, or its normal.
template <typename T>
concept SurfaceTexture = requires(const T& texture, const Surface& at) {
  { texture.evaluate(at) } -> std::same_as<Rgb>;
};

namespace detail {

template <typename T>
inline constexpr bool is_choice_of_textures = false;
template <typename... Ts>
inline constexpr bool is_choice_of_textures<OneOf<Ts...>> = ((Texture<Ts> || SurfaceTexture<Ts>)&&...);

}  // namespace detail

/// What colors surfaces: a texture of either kind, or one of several of these.
template <typename T>
concept ShadingTexture = Texture<T> || SurfaceTexture<T> || detail::is_choice_of_textures<T>;

/// A texture's color on a surface: by all of it where the texture asks for that, else by its coordinates.
template <ShadingTexture T>
[[nodiscard]] Rgb color_at(const T& texture, const Surface& at) {
  if constexpr (SurfaceTexture<T>) {
    return texture.evaluate(at);
  } else if constexpr (detail::is_choice_of_textures<T>) {
    return texture.visit([&](const auto& one) { return color_at(one, at); });
  } else {
    return texture.evaluate(at.uv);
  }
}

}  // namespace glint

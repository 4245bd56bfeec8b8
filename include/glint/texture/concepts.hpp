// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/color/rgb.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>
#include <glint/texture/uv_footprint.hpp>

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

/// A texture that can be filtered: asked with a footprint, it answers with its mean there.
template <typename T>
concept FilteringTexture = Texture<T> && requires(const T& texture, const Vec2<float>& uv, const UvFootprint& over) {
  { texture.evaluate(uv, over) } -> std::same_as<Rgb>;
};

namespace detail {

template <typename T>
inline constexpr bool is_choice_of_textures = false;
template <typename... Ts>
inline constexpr bool is_choice_of_textures<OneOf<Ts...>> = ((Texture<Ts> || SurfaceTexture<Ts>)&&...);

template <typename T>
inline constexpr bool asks_for_surface = SurfaceTexture<T> || FilteringTexture<T>;
template <typename... Ts>
inline constexpr bool asks_for_surface<OneOf<Ts...>> = (asks_for_surface<Ts> || ...);

template <typename T>
concept SaysThatItAsksForFootprints = requires {
  requires T::asks_for_footprints;
};

}  // namespace detail

/// Whether a type asks for footprints: textures that can be filtered, and all templates that have such a type among
/// their arguments, such as materials of textures and sum types of those. A type that is no template says so with a
/// member `static constexpr bool asks_for_footprints = true`.
template <typename T>
inline constexpr bool asks_for_footprints = FilteringTexture<T> || detail::SaysThatItAsksForFootprints<T>;
template <template <typename...> typename C, typename... Ts>
inline constexpr bool asks_for_footprints<C<Ts...>> = FilteringTexture<C<Ts...>> ||
                                                      detail::SaysThatItAsksForFootprints<C<Ts...>> ||
                                                      (asks_for_footprints<Ts> || ...);

/// What colors surfaces: a texture of either kind, or one of several of these.
template <typename T>
concept ShadingTexture = Texture<T> || SurfaceTexture<T> || detail::is_choice_of_textures<T>;

/// A texture's color on a surface: by all of it where the texture asks for that, else by its coordinates, filtered
/// where the texture can be.
template <ShadingTexture T>
[[nodiscard]] Rgb color_at(const T& texture, const Surface& at) {
  if constexpr (SurfaceTexture<T>) {
    return texture.evaluate(at);
  } else if constexpr (detail::is_choice_of_textures<T>) {
    return texture.visit([&](const auto& one) { return color_at(one, at); });
  } else if constexpr (FilteringTexture<T>) {
    return texture.evaluate(at.uv, uv_footprint(at));
  } else {
    return texture.evaluate(at.uv);
  }
}

/// A texture's color at coordinates, filtered where the texture can be.
template <typename T>
  requires(Texture<T> || detail::is_choice_of_textures<T>)
[[nodiscard]] Rgb color_at(const T& texture, const Vec2<float>& uv, const UvFootprint& over) {
  if constexpr (FilteringTexture<T>) {
    return texture.evaluate(uv, over);
  } else if constexpr (detail::is_choice_of_textures<T>) {
    return texture.visit([&](const auto& one) { return color_at(one, uv, over); });
  } else {
    return texture.evaluate(uv);
  }
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>

#include <glint/texture/concepts.hpp>

namespace glint {

/// Two textures, mixed as a third says: its luminance, held to [0, 1], is the share of the second.
///
/// Asks for the surface where one of the three does, and can be filtered where one can.
template <ShadingTexture A, ShadingTexture B, ShadingTexture S>
struct Mix {
  A first{};
  B second{};
  S share{};

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const requires(Texture<A>&& Texture<B>&& Texture<S>) {
    return mixed(first.evaluate(uv), second.evaluate(uv), share.evaluate(uv));
  }

  [[nodiscard]] Rgb evaluate(const Surface& at) const
      requires(detail::asks_for_surface<A> || detail::asks_for_surface<B> || detail::asks_for_surface<S>) {
    return mixed(color_at(first, at), color_at(second, at), color_at(share, at));
  }

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv, const UvFootprint& over) const
      requires(Texture<A>&& Texture<B>&& Texture<S>) {
    return mixed(color_at(first, uv, over), color_at(second, uv, over), color_at(share, uv, over));
  }

  [[nodiscard]] friend bool operator==(const Mix&, const Mix&) = default;

 private:
  [[nodiscard]] static Rgb mixed(const Rgb& a, const Rgb& b, const Rgb& share) noexcept {
    return a + Rgb(std::min(std::max(0.0F, luminance(share)), 1.0F)) * (b - a);
  }
};

template <ShadingTexture A, ShadingTexture B, ShadingTexture S>
Mix(A, B, S) -> Mix<A, B, S>;

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>

#include <glint/color/image.hpp>
#include <glint/texture/concepts.hpp>
#include <glint/texture/mapping.hpp>

namespace glint {

/// What a texture is between the centers of its pixels.
enum class Interpolation { Bilinear, Nearest };

/// What a texture is outside [0, 1]: itself again, its border, or its mirror image.
enum class Wrap { Repeat, Clamp, Mirror };

namespace detail {

/// s − floor(s), in [0, 1]. From 2²³ on floats are whole numbers; NaN counts as one.
[[nodiscard]] inline float fraction(float s) noexcept {
  if (!(std::abs(s) < 0x1p23F)) return 0;
  const float rest = s - static_cast<float>(static_cast<int>(s));
  return rest < 0 ? rest + 1 : rest;
}

/// Any coordinate, NaN too, brought into [0, 1].
[[nodiscard]] inline float wrap_coordinate(float s, Wrap wrap) noexcept {
  if (wrap == Wrap::Repeat) return fraction(s);
  if (wrap == Wrap::Clamp) return std::min(std::max(0.0F, s), 1.0F);
  const float twice = 2 * fraction(0.5F * s);
  return twice > 1 ? 2 - twice : twice;
}

/// The two pixels on either side of a coordinate along one axis, and the share of the second.
struct TexelPair {
  int first = 0;
  int second = 0;
  float share = 0;
};

/// Pixel i has its center at (i + ½) / size. Requires: size ≥ 1.
[[nodiscard]] inline TexelPair texel_pair(float s, int size, Wrap wrap) noexcept {
  const float x = wrap_coordinate(s, wrap) * static_cast<float>(size) - 0.5F;
  const int before = x < 0 ? -1 : static_cast<int>(x);  // floor(x), since x ≥ −½
  const float share = x - static_cast<float>(before);
  const int last = size - 1;
  if (before < 0) return {wrap == Wrap::Repeat ? last : 0, 0, share};
  if (before < last) return {before, before + 1, share};
  return {last, wrap == Wrap::Repeat ? 0 : last, share};
}

/// The pixel that holds a coordinate. Requires: size ≥ 1.
[[nodiscard]] inline int nearest_texel(float s, int size, Wrap wrap) noexcept {
  return std::min(static_cast<int>(wrap_coordinate(s, wrap) * static_cast<float>(size)), size - 1);
}

}  // namespace detail

/// An image as a texture. Copies share the image.
///
/// s = 0 is the left border of the image, t = 0 its upper border; pixel (i, j) has its center at ((i + ½) / width,
/// (j + ½) / height). Under Repeat the first and last columns blend across the seam on both sides. (Some renderers
/// clamp s · width − ½ at 0: they differ within half a pixel of the left and the upper border, and show a seam there.)
///
/// Errors: no image or an empty one is black; coordinates that are not finite give some pixel of the border.
struct ImageTexture {
  std::shared_ptr<const Image> image{};
  UvMapping mapping{};
  Interpolation interpolation = Interpolation::Bilinear;
  Wrap wrap_s = Wrap::Repeat;
  Wrap wrap_t = Wrap::Repeat;

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const noexcept {
    if (image == nullptr || image->empty()) return 0;
    const Image& texels = *image;
    const Vec2<float> st = mapping(uv);
    if (interpolation == Interpolation::Nearest) {
      return texels(detail::nearest_texel(st.x, texels.width(), wrap_s),
                    detail::nearest_texel(st.y, texels.height(), wrap_t));
    }
    const detail::TexelPair x = detail::texel_pair(st.x, texels.width(), wrap_s);
    const detail::TexelPair y = detail::texel_pair(st.y, texels.height(), wrap_t);
    const Rgb upper = lerp(texels(x.first, y.first), texels(x.second, y.first), x.share);
    const Rgb lower = lerp(texels(x.first, y.second), texels(x.second, y.second), x.share);
    return lerp(upper, lower, y.share);
  }

  /// The same image, shared, under the same settings.
  [[nodiscard]] friend bool operator==(const ImageTexture&, const ImageTexture&) noexcept = default;

 private:
  [[nodiscard]] static constexpr Rgb lerp(const Rgb& a, const Rgb& b, float share) noexcept {
    return a + Rgb(share) * (b - a);
  }
};

static_assert(Texture<ImageTexture>);

}  // namespace glint

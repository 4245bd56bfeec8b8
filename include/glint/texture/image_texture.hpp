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

/// What a texture is outside [0, 1]: itself again, its outermost pixels, its mirror image, or a black border.
enum class Wrap { Repeat, Clamp, Mirror, Border };

namespace detail {

/// s − floor(s), in [0, 1]. From 2²³ on floats are whole numbers; NaN counts as one.
[[nodiscard]] inline float fraction(float s) noexcept {
  if (!(std::abs(s) < 0x1p23F)) return 0;
  const float rest = s - static_cast<float>(static_cast<int>(s));
  return rest < 0 ? rest + 1 : rest;
}

/// Any coordinate, NaN too, brought into [0, 1]. Requires: not Border.
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

/// The two pixels under Border: either may be −1 or `size`, which are black.
[[nodiscard]] inline TexelPair bordered_texel_pair(float s, int size) noexcept {
  const float x = s * static_cast<float>(size) - 0.5F;
  if (!(x > -1 && x < static_cast<float>(size))) return {-1, -1, 0};
  const float before = std::floor(x);
  return {static_cast<int>(before), static_cast<int>(before) + 1, x - before};
}

/// Pixel i has its center at (i + ½) / size. Requires: size ≥ 1.
[[nodiscard]] inline TexelPair texel_pair(float s, int size, Wrap wrap) noexcept {
  if (wrap == Wrap::Border) return bordered_texel_pair(s, size);
  const float x = wrap_coordinate(s, wrap) * static_cast<float>(size) - 0.5F;
  const int before = x < 0 ? -1 : static_cast<int>(x);  // floor(x), since x ≥ −½
  const float share = x - static_cast<float>(before);
  const int last = size - 1;
  if (before < 0) return {wrap == Wrap::Repeat ? last : 0, 0, share};
  if (before < last) return {before, before + 1, share};
  return {last, wrap == Wrap::Repeat ? 0 : last, share};
}

/// The pixel that holds a coordinate; under Border −1 where none does. Requires: size ≥ 1.
[[nodiscard]] inline int nearest_texel(float s, int size, Wrap wrap) noexcept {
  if (wrap == Wrap::Border) return s >= 0 && s < 1 ? nearest_texel(s, size, Wrap::Clamp) : -1;
  return std::min(static_cast<int>(wrap_coordinate(s, wrap) * static_cast<float>(size)), size - 1);
}

/// A pixel; black outside the image.
[[nodiscard]] inline Rgb texel_or_black(const Image& image, int x, int y) noexcept {
  const bool inside = x >= 0 && y >= 0 && x < image.width() && y < image.height();
  return inside ? image(x, y) : Rgb{};
}

/// A weighted mean of the four pixels around (s, t); `texel(x, y)` looks one up.
template <typename Texel>
[[nodiscard]] Rgb bilinear(const TexelPair& x, const TexelPair& y, const Texel& texel) noexcept {
  const auto between = [](const Rgb& a, const Rgb& b, float share) { return a + Rgb(share) * (b - a); };
  const Rgb upper = between(texel(x.first, y.first), texel(x.second, y.first), x.share);
  const Rgb lower = between(texel(x.first, y.second), texel(x.second, y.second), x.share);
  return between(upper, lower, y.share);
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
    if (wrap_s == Wrap::Border || wrap_t == Wrap::Border) {
      return lookup(st, [&](int x, int y) { return detail::texel_or_black(texels, x, y); });
    }
    return lookup(st, [&](int x, int y) { return texels(x, y); });
  }

  /// The same image, shared, under the same settings.
  [[nodiscard]] friend bool operator==(const ImageTexture&, const ImageTexture&) noexcept = default;

 private:
  template <typename Texel>
  [[nodiscard]] Rgb lookup(const Vec2<float>& st, const Texel& texel) const noexcept {
    const Vec2i size = image->size();
    if (interpolation == Interpolation::Nearest) {
      return texel(detail::nearest_texel(st.x, size.x, wrap_s), detail::nearest_texel(st.y, size.y, wrap_t));
    }
    return detail::bilinear(detail::texel_pair(st.x, size.x, wrap_s), detail::texel_pair(st.y, size.y, wrap_t), texel);
  }
};

static_assert(Texture<ImageTexture>);

}  // namespace glint

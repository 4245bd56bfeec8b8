// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>

#include <glint/color/image.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>
#include <glint/texture/concepts.hpp>
#include <glint/texture/ewa.hpp>
#include <glint/texture/image_texture.hpp>
#include <glint/texture/mapping.hpp>
#include <glint/texture/mip_map.hpp>

namespace glint {

/// How a texture is averaged over a footprint.
enum class TextureFilter : std::uint8_t {
  Ewa,       ///< an ellipse of Gaussian weights: sharp along what is seen at a slant
  Trilinear  ///< a square as wide as the footprint is long: cheaper, and blurred at a slant
};

namespace detail {

/// Any coordinate, NaN too, brought near [0, 1] without changing what lies around it.
[[nodiscard]] inline float near_coordinate(float s, Wrap wrap) noexcept {
  if (wrap == Wrap::Repeat) return fraction(s);
  if (wrap == Wrap::Mirror) return 2 * fraction(0.5F * s);
  return std::min(std::max(-1024.0F, s), 1024.0F);
}

/// The pixel that stands at a whole number along one axis; under Border −1 outside the image.
[[nodiscard]] inline int wrapped_texel(int i, int size, Wrap wrap) noexcept {
  if (i >= 0 && i < size) return i;
  if (wrap == Wrap::Border) return -1;
  if (wrap == Wrap::Clamp) return i < 0 ? 0 : size - 1;
  const int period = wrap == Wrap::Mirror ? 2 * size : size;
  const int rest = i % period;
  const int inside = rest < 0 ? rest + period : rest;
  return inside < size ? inside : period - 1 - inside;
}

}  // namespace detail

/// An image as a texture that is averaged over what a path stands for, from a pyramid of ever coarser images. Copies
/// share the pyramid. Without a footprint it is ImageTexture, bilinear.
///
/// Footprints longer than `max_anisotropy` times their width are blurred across, which bounds the cost.
///
/// Requires: max_anisotropy ≥ 1.
/// Errors:   no pyramid or an empty one is black; coordinates that are not finite give some pixel of the border.
/// Cost:     Trilinear: eight pixels. Ewa: about 10 pixels for round footprints, 10 · max_anisotropy for long ones.
/// Source:   Williams (1983), see MipMap; for Ewa see elliptical_mean, with levels chosen by the shortest radius.
struct FilteredImageTexture {
  std::shared_ptr<const MipMap> pyramid{};
  UvMapping mapping{};
  TextureFilter filter = TextureFilter::Ewa;
  float max_anisotropy = 8;
  Wrap wrap_s = Wrap::Repeat;
  Wrap wrap_t = Wrap::Repeat;

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const noexcept { return evaluate(uv, {}); }

  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv, const UvFootprint& over) const noexcept {
    if (pyramid == nullptr || pyramid->empty()) return 0;
    const Vec2<float> st = mapping(uv);
    const Vec2<float> texels = mapping.scale * Vec2<float>(pyramid->level(0).size());
    const Ellipse ellipse = Ellipse::spanned(over.x * texels, over.y * texels);
    const float longest = ellipse.squared_radii().x;
    if (longest == 0) return bilinear(st, 0);
    if (!(longest < 1e30F)) return bilinear(st, last_level());
    if (filter == TextureFilter::Trilinear) return trilinear(st, longest);
    return elliptical(st, ellipse.rounded_to(max_anisotropy));
  }

  /// The same pyramid, shared, under the same settings.
  [[nodiscard]] friend bool operator==(const FilteredImageTexture&, const FilteredImageTexture&) noexcept = default;

 private:
  [[nodiscard]] int last_level() const noexcept { return pyramid->level_count() - 1; }

  /// The level whose pixels are as wide as that, between the finest and the coarsest.
  [[nodiscard]] float level_of(float squared_width) const noexcept {
    const float level = 0.5F * std::log2(std::max(1.0F, squared_width));
    return std::min(level, static_cast<float>(last_level()));
  }

  /// Between two levels; `at(level)` looks one up.
  template <typename F>
  [[nodiscard]] static Rgb between_levels(float level, const F& at) noexcept {
    const int finer = static_cast<int>(level);
    const float share = level - static_cast<float>(finer);
    const Rgb fine = at(finer);
    return share > 0 ? fine + Rgb(share) * (at(finer + 1) - fine) : fine;
  }

  [[nodiscard]] Rgb bilinear(const Vec2<float>& st, int level) const noexcept {
    const Image& texels = pyramid->level(level);
    return detail::bilinear(detail::texel_pair(st.x, texels.width(), wrap_s),
                            detail::texel_pair(st.y, texels.height(), wrap_t),
                            [&](int x, int y) { return detail::texel_or_black(texels, x, y); });
  }

  [[nodiscard]] Rgb trilinear(const Vec2<float>& st, float squared_width) const noexcept {
    return between_levels(level_of(squared_width), [&](int level) { return bilinear(st, level); });
  }

  [[nodiscard]] Rgb elliptical(const Vec2<float>& st, const Ellipse& ellipse) const noexcept {
    const float squared_width = ellipse.squared_radii().y;
    const float level = level_of(squared_width);
    const float excess = std::exp2(level) / std::sqrt(std::max(1.0F, squared_width));  // < 1 beyond the coarsest level
    const Vec2<float> near{detail::near_coordinate(st.x, wrap_s), detail::near_coordinate(st.y, wrap_t)};
    const Vec2<float> finest(pyramid->level(0).size());
    return between_levels(level, [&](int i) {
      const Image& texels = pyramid->level(i);
      const Vec2<float> size(texels.size());
      return elliptical_mean(near * size - 0.5F, ellipse.scaled(size / finest * excess), [&](int x, int y) {
        return detail::texel_or_black(texels, detail::wrapped_texel(x, texels.width(), wrap_s),
                                      detail::wrapped_texel(y, texels.height(), wrap_t));
      });
    });
  }
};

static_assert(FilteringTexture<FilteredImageTexture>);

}  // namespace glint

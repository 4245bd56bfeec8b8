// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include <glint/color/image.hpp>
#include <glint/color/srgb.hpp>
#include <glint/color/tone_curve.hpp>

namespace glint {

/// How linear light becomes a picture for the eye.
struct ToneOptions {
  float exposure = 0;  ///< in stops: each doubles the light
  ToneCurve curve = ToneCurve::Clip;

  [[nodiscard]] friend bool operator==(const ToneOptions&, const ToneOptions&) noexcept = default;
};

/// An image as 8-bit sRGB, for screens and PNG files: red, green, blue of each pixel, row by row from the top. What the
/// curve leaves brighter than white is clipped, channel by channel.
///
/// Errors: NaN becomes 0.
[[nodiscard]] inline std::vector<std::uint8_t> to_srgb8(const Image& image, const ToneOptions& options = {}) {
  const float scale = std::exp2(options.exposure);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * image.pixels().size());
  for (const Rgb& pixel : image.pixels()) {
    const Rgb shown = toned(pixel * scale, options.curve);
    for (const float channel : {shown.r, shown.g, shown.b}) bytes.push_back(encode_srgb8(channel));
  }
  return bytes;
}

}  // namespace glint

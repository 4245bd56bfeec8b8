// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include <glint/color/rgb.hpp>

namespace glint {

/// How bright light is brought into what a screen can show.
enum class ToneCurve : std::uint8_t {
  Clip,    ///< as it is up to white; what is brighter is cut off, channel by channel
  Filmic,  ///< Narkowicz's fit of the ACES curve: more contrast, bright colors roll off
  Hable,   ///< Hable's curve: a soft toe and a long shoulder
  Agx      ///< a sigmoid of stops after Sobotka's AgX: what is very bright turns white rather than garish
};

/// The names by which files and programs ask for the curves.
inline constexpr std::array<std::pair<std::string_view, ToneCurve>, 4> tone_curves{
    {{"clip", ToneCurve::Clip}, {"filmic", ToneCurve::Filmic}, {"hable", ToneCurve::Hable}, {"agx", ToneCurve::Agx}}};

/// Shapes: 0 to 0, rising; white at about 7.24, beyond which the fit goes on to 2.51 / 2.43.
/// Source: Narkowicz, "ACES Filmic Tone Mapping Curve" (2015).
[[nodiscard]] constexpr float filmic_curve(float x) noexcept {
  return x * (2.51F * x + 0.03F) / (x * (2.43F * x + 0.59F) + 0.14F);
}

/// The curve with its usual exposure of one stop, white at 11.2 / 2. The published form subtracts E / F from a fraction
/// to bring 0 to 0; here that is one fraction, so that it does exactly.
///
/// Shapes: 0 to 0, rising.
/// Source: Hable, "Uncharted 2: HDR Lighting" (GDC 2010).
[[nodiscard]] constexpr float hable_curve(float x) noexcept {
  const auto curve = [](float v) { return v * (0.042F * v + 0.005F) / (v * (0.045F * v + 0.15F) + 0.018F); };
  return curve(2 * x) / curve(11.2F);
}

/// A sigmoid from 10 stops below middle gray, 0.18, to 6.5 above it; middle gray stays. The slope there is 2.4 in stops
/// over 16.5 and a display of gamma 2.4, toe and shoulder have the power 1.5.
///
/// Shapes: what is darker than the range to 0, brighter to 1, rising.
/// Source: Sobotka, "AgX" (2022), for range, slope and power.
[[nodiscard]] inline float agx_curve(float x) noexcept {
  if (!(x > 0)) return 0;
  constexpr float slope = 2.4F;
  constexpr float power = 1.5F;
  constexpr float pivot = 10 / 16.5F;
  const float pivot_shown = std::pow(0.18F, 1 / 2.4F);
  const float stops = std::min(std::max(0.0F, (std::log2(x / 0.18F) + 10) / 16.5F), 1.0F);
  const bool toe = stops < pivot;
  const float room_in = toe ? pivot : 1 - pivot;
  const float room_out = toe ? pivot_shown : 1 - pivot_shown;
  const float rise = slope * std::abs(stops - pivot);
  // x / (1 + (x / limit)^p)^(1/p), with the limit that leads to the end of the range.
  const float bend = std::pow(room_out, -power) - std::pow(slope * room_in, -power);
  const float bent = rise / std::pow(1 + std::pow(rise, power) * bend, 1 / power);
  return std::pow(std::max(0.0F, toe ? pivot_shown - bent : pivot_shown + bent), 2.4F);
}

/// Linear light to the linear light a screen is to show, 1 its white; what is still brighter is to be cut off. All but
/// Agx treat each channel by itself. Agx mixes a fifth of gray into colors and takes as much out of the result.
///
/// Ensures: black stays black, gray stays gray.
/// Errors:  negative values count as 0, except by Clip; NaN stays NaN, or becomes 0.
[[nodiscard]] inline Rgb toned(const Rgb& light, ToneCurve curve) noexcept {
  if (curve == ToneCurve::Clip) return light;
  const auto each = [](const Rgb& c, auto f) { return Rgb{f(c.r), f(c.g), f(c.b)}; };
  // Beyond the largest value squares overflow, and all curves have long reached white.
  const Rgb c = each(light, [](float v) { return v < 0 ? 0 : std::min(v, 1e9F); });
  if (curve == ToneCurve::Filmic) return each(c, filmic_curve);
  if (curve == ToneCurve::Hable) return each(c, hable_curve);
  constexpr float share = 0.2F;
  const float gray = (c.r + c.g + c.b) / 3;
  const Rgb shown = each(c * (1 - share) + Rgb(gray * share), agx_curve);
  const float gray_shown = (shown.r + shown.g + shown.b) / 3;
  return each((shown - Rgb(gray_shown * share)) / (1 - share), [](float v) { return std::max(0.0F, v); });
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include <glint/color/rgb.hpp>

namespace glint {

/// What a metal does to light: its complex index of refraction eta + i k, for a conductor in air.
struct Metal {
  Rgb eta{};
  Rgb k{};

  [[nodiscard]] friend constexpr bool operator==(const Metal&, const Metal&) noexcept = default;
};

/// Measured metals: `RoughConductor<Ggx>{.eta = metals::gold.eta, .k = metals::gold.k}`.
///
/// Red, green and blue are the constants at 650, 550 and 450 nm, interpolated linearly in wavelength between the
/// neighboring rows of the tables; nothing is averaged over a band. Reflectances thus stay within 0.07 of those from
/// whole spectra, where deep colors like gold's lie outside of Rec. 709.
///
/// Source: aluminum: Smith, Shiles, Inokuti in Palik, Handbook of Optical Constants of Solids (1985); gold, silver,
///         copper: Johnson, Christy, "Optical Constants of the Noble Metals", Physical Review B 6, 1972; chromium,
///         iron, titanium: Johnson, Christy, "Optical Constants of Transition Metals", Physical Review B 9, 1974;
///         tungsten: Weaver, Olson, Lynch, "Optical Properties of Crystalline Tungsten", Physical Review B 12, 1975.
namespace metals {

inline constexpr Metal aluminum{{1.470F, 0.960F, 0.620F}, {7.790F, 6.690F, 5.470F}};
inline constexpr Metal chromium{{3.107F, 3.181F, 2.323F}, {3.331F, 3.329F, 3.135F}};
inline constexpr Metal copper{{0.238F, 1.007F, 1.240F}, {3.626F, 2.582F, 2.393F}};
inline constexpr Metal gold{{0.156F, 0.424F, 1.383F}, {3.602F, 2.472F, 1.915F}};
inline constexpr Metal iron{{2.911F, 2.950F, 2.584F}, {3.089F, 2.932F, 2.767F}};
inline constexpr Metal silver{{0.052F, 0.060F, 0.040F}, {4.409F, 3.597F, 2.648F}};
inline constexpr Metal titanium{{2.741F, 2.542F, 2.267F}, {3.814F, 3.435F, 3.038F}};
inline constexpr Metal tungsten{{3.671F, 3.522F, 3.315F}, {2.932F, 2.741F, 2.516F}};

}  // namespace metals

/// A metal that reflects a color where it is seen straight on.
///
/// A reflectance r belongs to a curve of indices; the one taken is the geometric mean of the curve's least and greatest
/// eta, (1 + √r) / √(1 + r), close to aluminum's.
///
/// Requires: 0 ≤ color ≤ 1; held to [0.001, 0.999]: a metal that reflects nothing is air, and one that reflects all has
///           no index.
/// Source:   the curve: Gulbrandsen, "Artist Friendly Metallic Fresnel", JCGT 3(4), 2014, where users choose on it.
[[nodiscard]] inline Metal metal_of_color(const Rgb& color) noexcept {
  Metal result;
  for (float Rgb::*const channel : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    const float r = std::clamp(color.*channel, 1e-3F, 0.999F);
    const float eta = (1.0F + std::sqrt(r)) / std::sqrt(1.0F + r);
    const float above = r * (eta + 1.0F) * (eta + 1.0F) - (eta - 1.0F) * (eta - 1.0F);
    result.eta.*channel = eta;
    result.k.*channel = std::sqrt(std::max(0.0F, above) / (1.0F - r));
  }
  return result;
}

}  // namespace glint

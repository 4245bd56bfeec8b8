// SPDX-License-Identifier: MIT
#pragma once

namespace glint {

/// The power heuristic with exponent two: the weight of a sample drawn with density `pdf` where another strategy would
/// have drawn it with density `other`.
///
/// Source: Veach, "Robust Monte Carlo Methods for Light Transport Simulation" (1997), section 9.2.4.
[[nodiscard]] constexpr float power_heuristic(float pdf, float other) noexcept {
  if (!(pdf > 0)) return 0;
  const float ratio = other / pdf;  // divided first: squares of large densities overflow
  return 1 / (1 + ratio * ratio);
}

}  // namespace glint

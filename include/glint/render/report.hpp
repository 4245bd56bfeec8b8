// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

namespace glint {

/// What a rendering took.
struct RenderReport {
  std::uint64_t samples = 0;  ///< camera paths
  std::uint64_t rays = 0;     ///< closest-hit and occlusion queries
  std::uint64_t dropped = 0;  ///< samples left out because they were not finite
  double seconds = 0;
  bool complete = true;  ///< false where it was stopped early
  bool clamped = false;  ///< true where a LightClamp was on: the image may be darker than it should be

  constexpr RenderReport& operator+=(const RenderReport& other) noexcept {
    samples += other.samples;
    rays += other.rays;
    dropped += other.dropped;
    seconds += other.seconds;
    complete = complete && other.complete;
    clamped = clamped || other.clamped;
    return *this;
  }
  [[nodiscard]] friend constexpr bool operator==(const RenderReport&, const RenderReport&) noexcept = default;
};

}  // namespace glint

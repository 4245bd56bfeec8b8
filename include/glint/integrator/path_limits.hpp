// SPDX-License-Identifier: MIT
#pragma once
#include <limits>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// How often a path may be scattered, by kind: transmissive to the other side of a surface, else diffuse by a diffuse
/// lobe, glossy by any other one, specular ones included. A path still meets lights after one bounce more, so that a
/// limit of 0 leaves what such surfaces show of lights and takes what they show of other surfaces.
///
/// Light that takes other ways is missing: the image is darker, and sooner done.
struct BounceLimits {
  static constexpr int unlimited = std::numeric_limits<int>::max();

  int diffuse = unlimited;
  int glossy = unlimited;
  int transmissive = unlimited;

  /// Takes one of what is left. False where there was none.
  [[nodiscard]] constexpr bool take(const Vec3<float>& wo, const BsdfSample& scattered) noexcept {
    if (wo.z * scattered.wi.z < 0) return transmissive-- > 0;
    return scattered.lobe == Lobe::Diffuse ? diffuse-- > 0 : glossy-- > 0;
  }

  [[nodiscard]] friend constexpr bool operator==(const BounceLimits&, const BounceLimits&) noexcept = default;
};

/// Takes the brightest of what single paths bring, with its noise. Light seen directly has none, and stays.
///
/// Errors: where light was lost the image is biased: darker than it should be.
struct LightClamp {
  float direct = infinity<float>;    ///< for a path of two segments: the most that its largest component may be
  float indirect = infinity<float>;  ///< for longer ones

  [[nodiscard]] constexpr bool is_on() const noexcept { return direct < infinity<float> || indirect < infinity<float>; }

  /// What is left of the light that a path of so many segments brings. Its color stays.
  [[nodiscard]] constexpr Rgb operator()(const Rgb& light, int segments) const noexcept {
    const float limit = segments > 2 ? indirect : segments == 2 ? direct : infinity<float>;
    const float brightest = max_component(light);
    return brightest > limit ? light * (limit / brightest) : light;
  }

  [[nodiscard]] friend constexpr bool operator==(const LightClamp&, const LightClamp&) noexcept = default;
};

}  // namespace glint

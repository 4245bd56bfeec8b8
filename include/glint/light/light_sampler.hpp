// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/distribution.hpp>

namespace glint {

/// A light chosen among several.
struct ChosenLight {
  std::uint32_t index = 0;
  float probability = 0;
};

/// Chooses lights in proportion to the luminance of their power.
class PowerLightSampler {
 public:
  PowerLightSampler() = default;

  template <Light L>
  PowerLightSampler(std::span<const L> lights, const Aabb<float>& scene) : choice_(weights(lights, scene)) {}

  /// Requires: there is a light with power, see `empty()`.
  [[nodiscard]] ChosenLight choose(float u) const noexcept {
    const auto chosen = choice_.sample(u);
    return {static_cast<std::uint32_t>(chosen.index), chosen.probability};
  }

  [[nodiscard]] float probability(std::uint32_t light) const noexcept { return choice_.probability(light); }

  /// True where nothing shines.
  [[nodiscard]] bool empty() const noexcept { return !(choice_.total() > 0); }

 private:
  template <Light L>
  [[nodiscard]] static std::vector<float> weights(std::span<const L> lights, const Aabb<float>& scene) {
    std::vector<float> result;
    result.reserve(lights.size());
    for (const L& light : lights) {
      const float power = luminance(light.power(scene));
      result.push_back(power > 0 ? std::min(power, 1e30F) : 0.0F);  // a sun over an unbounded scene has infinite power
    }
    return result;
  }

  AliasTable choice_;
};

}  // namespace glint

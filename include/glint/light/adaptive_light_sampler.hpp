// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glint/light/light_bvh.hpp>
#include <glint/light/light_sampler.hpp>

namespace glint {

/// Chooses by power among few lights, by a tree among many: what scenes do unless told otherwise.
class AdaptiveLightSampler {
 public:
  /// From how many lights on a tree is worth its price, a descent at each surface.
  static constexpr std::size_t many = 16;

  AdaptiveLightSampler() = default;

  template <Light L>
  AdaptiveLightSampler(std::span<const L> lights, const Aabb<float>& scene) : by_tree_(lights.size() >= many) {
    if (by_tree_) {
      tree_ = LightBvh(lights, scene);
    } else {
      power_ = PowerLightSampler(lights, scene);
    }
  }

  [[nodiscard]] std::optional<ChosenLight> choose(const Vec3<float>& from, const Vec3<float>& normal,
                                                  float u) const noexcept {
    return by_tree_ ? tree_.choose(from, normal, u) : power_.choose(from, normal, u);
  }
  [[nodiscard]] float probability(const Vec3<float>& from, const Vec3<float>& normal,
                                  std::uint32_t light) const noexcept {
    return by_tree_ ? tree_.probability(from, normal, light) : power_.probability(light);
  }

 private:
  PowerLightSampler power_;
  LightBvh tree_;
  bool by_tree_ = false;
};

static_assert(LightSampler<AdaptiveLightSampler>);

}  // namespace glint

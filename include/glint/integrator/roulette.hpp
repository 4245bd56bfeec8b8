// SPDX-License-Identifier: MIT
#pragma once
#include <glint/color/rgb.hpp>
#include <glint/sampler/concepts.hpp>

namespace glint {

/// Russian roulette on the throughput of a path, once that is below a bound; a survivor stands for those that did not.
template <Sampler R>
[[nodiscard]] bool survives_roulette(Rgb& throughput, float below, R& sampler) {
  const float strength = max_component(throughput);
  if (strength >= below) return true;
  const float chance = strength / below;
  if (!(sampler.next_1d() < chance)) return false;
  throughput /= chance;
  return true;
}

}  // namespace glint

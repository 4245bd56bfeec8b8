// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>

#include <glint/color/rgb.hpp>
#include <glint/color/rgb_sum.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// Light by the number of segments of its paths, from camera to light.
struct LightShares {
  Rgb emission{};  ///< one: what shines is seen, or the background
  Rgb direct{};    ///< two: scattered once; what is seen in a mirror is light scattered once
  Rgb indirect{};  ///< more
  Rgb sum{};       ///< of all

  [[nodiscard]] friend constexpr bool operator==(const LightShares&, const LightShares&) noexcept = default;
};

/// An integrator that tells light by the length of its path: `for_each_light(scene, ray, sampler, bring)` calls
/// bring(light, segments) with the terms of `radiance`, which is their RgbSum in that order.
template <typename I, typename S, typename R>
concept TermwiseIntegratorFor = IntegratorFor<I, S, R> &&
    requires(const I& integrator, const S& scene, const Ray<float>& ray, R& sampler) {
  integrator.for_each_light(scene, ray, sampler, [](const Rgb& /*light*/, int /*segments*/) {});
};

/// The light along a ray in its shares.
///
/// Ensures: `sum` is what `radiance` returns, to the last bit.
template <SceneLike S, Sampler R, TermwiseIntegratorFor<S, R> I, typename F = NoFootprint>
[[nodiscard]] LightShares light_shares(const I& integrator, const S& scene, const Ray<float>& ray, R& sampler,
                                       const F& footprint = {}) {
  RgbSum sum;
  std::array<RgbSum, 3> by_segments;
  const auto bring = [&](const Rgb& light, int segments) {
    sum.add(light);
    by_segments[static_cast<std::size_t>(std::min(segments, 3) - 1)].add(light);
  };
  if constexpr (requires { integrator.for_each_light(scene, ray, sampler, bring, footprint); }) {
    integrator.for_each_light(scene, ray, sampler, bring, footprint);
  } else {
    integrator.for_each_light(scene, ray, sampler, bring);
  }
  return {by_segments[0].value(), by_segments[1].value(), by_segments[2].value(), sum.value()};
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <glint/color/rgb_sum.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/integrator/light_search.hpp>
#include <glint/integrator/path_limits.hpp>
#include <glint/integrator/roulette.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// A path tracer: an unbiased estimate of all light transport up to a number of segments.
///
/// Source: Kajiya, "The Rendering Equation" (SIGGRAPH 1986); Veach (1997), chapters 9 and 10.
struct Path {
  int max_depth = 12;           ///< segments from camera to light: 1 is light seen directly, 2 is direct lighting
  float roulette_below = 0.1F;  ///< paths whose throughput falls below this may be ended, the others made stronger
  LightStrategy strategy = LightStrategy::Mis;
  BounceLimits limits{};  ///< none by default
  LightClamp clamp{};     ///< off by default

  template <SceneLike S, Sampler R, typename F = NoFootprint>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& sampler, const F& footprint = {}) const {
    RgbSum sum;
    const auto bring = [&](const Rgb& light, int /*segments*/) { sum.add(light); };
    for_each_light(scene, ray, sampler, bring, footprint);
    return sum.value();
  }

  /// The terms of `radiance` in the order of their sum: calls bring(light, segments) with what each path brings.
  template <SceneLike S, Sampler R, typename Bring, typename F = NoFootprint>
  void for_each_light(const S& scene, const Ray<float>& ray, R& sampler, const Bring& bring,
                      const F& footprint = {}) const {
    if (clamp.is_on()) {
      const auto clamped = [&](const Rgb& light, int segments) { bring(clamp(light, segments), segments); };
      trace(scene, ray, sampler, clamped, footprint);
    } else {
      trace(scene, ray, sampler, bring, footprint);
    }
  }

 private:
  /// for_each_light, not clamped.
  template <SceneLike S, Sampler R, typename Bring, typename F>
  void trace(const S& scene, Ray<float> ray, R& sampler, const Bring& bring, F footprint) const {
    const LightSearch search{strategy};
    BounceLimits left = limits;
    Rgb throughput{1};
    Arrival arrival;
    for (int last = max_depth, segments = 1; segments <= last; ++segments) {
      const auto at = interact(scene, ray, footprint);
      if (!at) {
        return bring(throughput * search.found_background(scene, ray.direction, arrival), segments);
      }
      if (at->light < scene.light_count()) {
        bring(throughput * search.found_light(scene, *at, arrival), segments);
      }
      if (segments == last) break;

      const Vec3<float> wo = at->to_local(at->wo);
      const bool next_event = search.looks_from(*at);
      if (next_event) bring(throughput * search.looked_for_light(scene, *at, wo, sampler), segments + 1);

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(wo, lobe, sampler.next_2d());
      if (!scattered) break;
      throughput *= scattered->weight;
      if (!survives_roulette(throughput, roulette_below, sampler)) break;
      if (!left.take(wo, *scattered)) last = segments + 1;
      arrival.leave(*at, *scattered, next_event);
      at->leave(at->to_world(scattered->wi), ray);
      footprint.scatter(*at, *scattered, ray.direction);
    }
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <glint/color/rgb_sum.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/integrator/light_search.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// Direct light alone: specular lobes are followed to the first other one, and what shines on that is found by sampling
/// lights (LightStrategy::NextEvent), by sampling the BSDF (RandomWalk), or by both. What shines is seen; nothing is
/// lit by what does not.
///
/// By NextEvent no ray leaves a surface but along specular lobes and to lights.
///
/// Source: Veach (1997), chapter 9.
struct Direct {
  int max_depth = 12;  ///< segments from camera to light, as in Path: 2 follows no specular lobe to a lit surface
  LightStrategy strategy = LightStrategy::Mis;

  template <SceneLike S, Sampler R, typename F = NoFootprint>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& sampler, const F& footprint = {}) const {
    RgbSum sum;
    const auto bring = [&](const Rgb& light, int /*segments*/) { sum.add(light); };
    for_each_light(scene, ray, sampler, bring, footprint);
    return sum.value();
  }

  /// The terms of `radiance` in the order of their sum: calls bring(light, segments) with what each path brings.
  template <SceneLike S, Sampler R, typename Bring, typename F = NoFootprint>
  void for_each_light(const S& scene, Ray<float> ray, R& sampler, const Bring& bring, F footprint = {}) const {
    const LightSearch search{strategy};
    Rgb throughput{1};
    Arrival arrival;
    for (int last = max_depth, segments = 1; segments <= last; ++segments) {
      const auto at = interact(scene, ray, footprint);
      if (!at) return bring(throughput * search.found_background(scene, ray.direction, arrival), segments);
      if (at->light < scene.light_count()) bring(throughput * search.found_light(scene, *at, arrival), segments);
      if (segments == last) break;

      const Vec3<float> wo = at->to_local(at->wo);
      const bool next_event = search.looks_from(*at);
      if (next_event) bring(throughput * search.looked_for_light(scene, *at, wo, sampler), segments + 1);

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(wo, lobe, sampler.next_2d());
      if (!scattered) break;
      const bool specular = scattered->lobe == Lobe::Specular;
      if (!specular && strategy == LightStrategy::NextEvent) break;
      if (!specular) last = segments + 1;
      throughput *= scattered->weight;
      arrival = {at->surface.position, at->frame.z, scattered->pdf, next_event && !specular};
      ray = at->leave(at->to_world(scattered->wi));
      footprint.scatter(*at, *scattered, ray.direction);
    }
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
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
  [[nodiscard]] Rgb radiance(const S& scene, Ray<float> ray, R& sampler, F footprint = {}) const {
    const LightSearch search{strategy};
    Rgb throughput{1};
    Rgb sum;
    Arrival arrival;
    for (int last = max_depth, segments = 1; segments <= last; ++segments) {
      const auto at = interact(scene, ray, footprint);
      if (!at) return sum + throughput * search.found_background(scene, ray.direction, arrival);
      if (at->light < scene.light_count()) sum += throughput * search.found_light(scene, *at, arrival);
      if (segments == last) break;

      const Vec3<float> wo = at->to_local(at->wo);
      const bool next_event = search.looks_from(*at);
      if (next_event) sum += throughput * search.looked_for_light(scene, *at, wo, sampler);

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
    return sum;
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstdint>

#include <glint/integrator/concepts.hpp>
#include <glint/integrator/direct_light.hpp>
#include <glint/integrator/mis.hpp>
#include <glint/light/concepts.hpp>

namespace glint {

/// How paths find light.
enum class LightStrategy : std::uint8_t {
  Mis,        ///< by chance and by next-event estimation, each weighted by the power heuristic
  NextEvent,  ///< by next-event estimation, by chance only what it cannot find
  RandomWalk  ///< by chance alone: what the others are tested against; blind to point lights
};

/// A path tracer: an unbiased estimate of all light transport up to a number of segments.
///
/// Source: Kajiya, "The Rendering Equation" (SIGGRAPH 1986); Veach (1997), chapters 9 and 10.
struct Path {
  int max_depth = 12;           ///< segments from camera to light: 1 is light seen directly, 2 is direct lighting
  float roulette_below = 0.1F;  ///< paths whose throughput falls below this may be ended, the others made stronger
  LightStrategy strategy = LightStrategy::Mis;

  template <SceneLike S, Sampler R>
  [[nodiscard]] Rgb radiance(const S& scene, Ray<float> ray, R& sampler) const {
    Rgb throughput{1};
    Rgb sum;
    Arrival arrival;
    for (int segments = 1; segments <= max_depth; ++segments) {
      const auto at = scene.interact(ray);
      if (!at) return sum + throughput * found_background(scene, ray.direction, arrival);
      if (at->light < scene.light_count()) sum += throughput * found_light(scene, *at, arrival);
      if (segments == max_depth) break;

      const Vec3<float> wo = at->to_local(at->wo);
      const bool next_event = strategy != LightStrategy::RandomWalk && !at->bsdf.is_specular();
      if (next_event) sum += throughput * looked_for_light(scene, *at, wo, sampler);

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(wo, lobe, sampler.next_2d());
      if (!scattered) break;
      throughput *= scattered->weight;
      if (!survives(throughput, sampler)) break;
      arrival = {at->surface.position, at->frame.z, scattered->pdf, next_event && scattered->lobe != Lobe::Specular};
      ray = at->leave(at->to_world(scattered->wi));
    }
    return sum;
  }

 private:
  /// How a path came to where it is.
  struct Arrival {
    Vec3<float> from{0.0F};
    Vec3<float> normal{0.0F};
    float pdf = 0;            ///< of the direction it took
    bool next_event = false;  ///< whether next-event estimation looked for the same light
  };

  /// The weight of light met by chance.
  [[nodiscard]] float chance_weight(const Arrival& arrival, float light_pdf) const noexcept {
    if (!arrival.next_event || !(light_pdf > 0)) return 1;
    return strategy == LightStrategy::NextEvent ? 0.0F : power_heuristic(arrival.pdf, light_pdf);
  }

  template <SceneLike S, Bsdf B>
  [[nodiscard]] Rgb found_light(const S& scene, const Interaction<B>& at, const Arrival& arrival) const {
    const auto& light = scene.light(at.light);
    const Rgb radiance = emission(light, at.surface, at.wo);
    if (is_black(radiance)) return {};
    if (!arrival.next_event) return radiance;
    const float chance = scene.light_sampler().probability(arrival.from, arrival.normal, at.light);
    const float pdf = chance * surface_pdf(light, arrival.from, at.surface);
    return radiance * chance_weight(arrival, pdf);
  }

  template <SceneLike S>
  [[nodiscard]] Rgb found_background(const S& scene, const Vec3<float>& direction, const Arrival& arrival) const {
    if (!arrival.next_event) return scene.background(direction);
    Rgb sum;
    for (const std::uint32_t i : scene.infinite_lights()) {
      const Rgb radiance = background(scene.light(i), direction);
      if (is_black(radiance)) continue;
      const float chance = scene.light_sampler().probability(arrival.from, arrival.normal, i);
      const float pdf = chance * background_pdf(scene.light(i), direction);
      sum += radiance * chance_weight(arrival, pdf);
    }
    return sum;
  }

  /// Next-event estimation: one light, one point on it.
  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] Rgb looked_for_light(const S& scene, const Interaction<B>& at, const Vec3<float>& wo,
                                     R& sampler) const {
    const float choice = sampler.next_1d();
    const Vec2<float> u = sampler.next_2d();
    const auto chosen = scene.light_sampler().choose(at.surface.position, at.frame.z, choice);
    if (!chosen) return {};
    const auto light = scene.light(chosen->index).sample(at.surface.position, u);
    if (!light) return {};
    const float pdf = chosen->probability * light->pdf;
    const bool only_way = light->is_delta || strategy == LightStrategy::NextEvent;
    const float weight = only_way ? 1 : power_heuristic(pdf, at.bsdf.pdf(wo, at.to_local(light->wi)));
    return reflected(scene, at, wo, *light) * (weight / pdf);
  }

  /// Russian roulette on the throughput; a survivor stands for those that did not.
  template <Sampler R>
  [[nodiscard]] bool survives(Rgb& throughput, R& sampler) const {
    const float strength = max_component(throughput);
    if (strength >= roulette_below) return true;
    const float chance = strength / roulette_below;
    if (!(sampler.next_1d() < chance)) return false;
    throughput /= chance;
    return true;
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include <glint/integrator/direct_light.hpp>
#include <glint/integrator/mis.hpp>
#include <glint/light/concepts.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/interaction.hpp>

namespace glint {

/// How paths find light.
enum class LightStrategy : std::uint8_t {
  Mis,        ///< by chance and by next-event estimation, each weighted by the power heuristic
  NextEvent,  ///< by next-event estimation, by chance only what it cannot find
  RandomWalk  ///< by chance alone: what the others are tested against; blind to point lights
};

/// How a path came to where it is.
struct Arrival {
  Vec3<float> from{0.0F};
  Vec3<float> normal{0.0F};
  float pdf = 0;            ///< of the direction it took
  bool next_event = false;  ///< whether next-event estimation looked for the same light

  /// From where `at` is, as sampled there; `looked` says whether next-event estimation was tried.
  template <Bsdf B>
  void leave(const Interaction<B>& at, const BsdfSample& scattered, bool looked) noexcept {
    from = at.surface.position;  // one by one: copies of what was just written stall the processor
    normal = at.frame.z;
    pdf = scattered.pdf;
    next_event = looked && scattered.lobe != Lobe::Specular;
  }
};

/// Finds the light at the vertices of a path. What is returned is still to be multiplied by the path's throughput.
///
/// Source: Veach (1997), chapters 8 and 9.
struct LightSearch {
  LightStrategy strategy = LightStrategy::Mis;

  /// Whether looked_for_light is of use there.
  template <Bsdf B>
  [[nodiscard]] bool looks_from(const Interaction<B>& at) const noexcept {
    return strategy != LightStrategy::RandomWalk && !at.bsdf.is_specular();
  }

  /// The light of a surface that was met by chance. Requires: the surface shines.
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

  /// The light of the background that was met by chance.
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

 private:
  /// The weight of light met by chance.
  [[nodiscard]] float chance_weight(const Arrival& arrival, float light_pdf) const noexcept {
    if (!arrival.next_event || !(light_pdf > 0)) return 1;
    return strategy == LightStrategy::NextEvent ? 0.0F : power_heuristic(arrival.pdf, light_pdf);
  }
};

}  // namespace glint

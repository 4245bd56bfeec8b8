// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/camera/importance.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/integrator/emitters.hpp>
#include <glint/integrator/light_scattering.hpp>
#include <glint/integrator/roulette.hpp>
#include <glint/light/concepts.hpp>

namespace glint {

class PreparedLightTracer;

/// Follows light from its sources and shows the camera each surface it meets: all that is not seen through specular
/// surfaces. Light seen directly is looked for from the camera. Caustics are its strength.
///
/// Requires: lights answer emit() (EmittingLight), the camera sample_toward() (ImportanceGenerator): what does not is
///           black. Environments whose choice is compensated for MIS are not traced in full.
/// Source:   Arvo, "Backward Ray Tracing" (SIGGRAPH course notes, 1986); Dutré, Lafortune, Willems, "Monte Carlo Light
///           Tracing with Direct Computation of Pixel Intensities" (1993).
struct LightTracer {
  int max_depth = 12;           ///< segments from camera to light, as in Path
  float roulette_below = 0.1F;  ///< as in Path

  template <BoundedScene S>
  [[nodiscard]] PreparedLightTracer prepare(const S& scene) const;
};

/// The light tracer of one scene.
class PreparedLightTracer {
 public:
  PreparedLightTracer(const LightTracer& options, Emitters emitters)
      : options_(options), emitters_(std::move(emitters)) {}

  template <SceneLike S, Sampler R, RayGenerator G, typename Splat>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& sampler, const G& camera,
                             const Splat& splat) const {
    if (options_.max_depth < 1) return {};
    trace_light(scene, sampler, camera, splat);
    const auto at = scene.interact(ray);
    if (!at) return scene.background(ray.direction);
    return at->light < scene.light_count() ? emission(scene.light(at->light), at->surface, at->wo) : Rgb{};
  }

 private:
  template <SceneLike S, Sampler R, RayGenerator G, typename Splat>
  void trace_light(const S& scene, R& sampler, const G& camera, const Splat& splat) const {
    const Vec2<float> lens = sampler.next_2d();
    const auto start = emitters_.sample(scene, sampler);
    if (!start) return;
    const Rgb flux = start->flux();
    Rgb throughput{1};
    Ray<float> ray = start->from.ray;
    for (int segments = 2; segments <= options_.max_depth; ++segments) {
      const auto at = scene.interact(ray);
      if (!at) return;
      const Vec3<float> wo = at->to_local(at->wo);
      if (!at->bsdf.is_specular()) show(scene, *at, wo, flux * throughput, camera, lens, splat);
      if (segments == options_.max_depth) return;

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(wo, lobe, sampler.next_2d());
      if (!scattered) return;
      const Vec3<float> direction = at->to_world(scattered->wi);
      throughput *= flux_weight(*at, wo, *scattered, direction);
      if (!survives_roulette(throughput, options_.roulette_below, sampler)) return;
      ray = at->leave(direction);
    }
  }

  /// What a surface sends to the camera.
  template <SceneLike S, Bsdf B, RayGenerator G, typename Splat>
  static void show(const S& scene, const Interaction<B>& at, const Vec3<float>& wo, const Rgb& flux, const G& camera,
                   const Vec2<float>& lens, const Splat& splat) {
    const auto seen = sample_toward(camera, at.surface.position, lens);
    if (!seen) return;
    const Rgb value = flux * scattered_flux(at, wo, seen->wi, at.to_local(seen->wi)) * seen->importance;
    if (!is_black(value) && !scene.occluded(at.leave_to(seen->target))) splat(seen->film, value);
  }

  LightTracer options_;
  Emitters emitters_;
};

template <BoundedScene S>
PreparedLightTracer LightTracer::prepare(const S& scene) const {
  return {*this, Emitters(scene)};
}

}  // namespace glint

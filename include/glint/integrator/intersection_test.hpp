// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include <glint/integrator/concepts.hpp>
#include <glint/integrator/direct_light.hpp>
#include <glint/light/concepts.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

/// How the light of a point fades with distance r.
enum class Falloff : std::uint8_t {
  InverseSquare,  ///< 1 / r²: physics
  None,           ///< 1: the light's strength at unit distance everywhere
  Square          ///< r²: a slip of a ray tracing course, kept so that its images can be reproduced
};

/// Follows specular surfaces to the first other one, and shades that with all lights, one sample each. What shines is
/// seen; nothing is lit indirectly.
struct IntersectionTest {
  int max_depth = 16;  ///< surfaces met along a path, the shaded one included
  Falloff falloff = Falloff::InverseSquare;

  template <SceneLike S, Sampler R, typename F = NoFootprint>
  [[nodiscard]] Rgb radiance(const S& scene, Ray<float> ray, R& sampler, F footprint = {}) const {
    Rgb throughput{1};
    Rgb sum;
    for (int depth = 0; depth < max_depth; ++depth) {
      const auto at = interact(scene, ray, footprint);
      if (!at) return sum + throughput * scene.background(ray.direction);
      if (at->light < scene.light_count()) sum += throughput * emission(scene.light(at->light), at->surface, at->wo);
      if (!at->bsdf.is_specular()) return sum + throughput * direct(scene, *at, sampler);

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(at->to_local(at->wo), lobe, sampler.next_2d());
      if (!scattered) return sum;
      throughput *= scattered->weight;
      ray = at->leave(at->to_world(scattered->wi));
      footprint.scatter(*at, *scattered, ray.direction);
    }
    return sum;
  }

 private:
  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] Rgb direct(const S& scene, const Interaction<B>& at, R& sampler) const {
    const Vec3<float> wo = at.to_local(at.wo);
    Rgb sum;
    for (std::uint32_t i = 0; i < scene.light_count(); ++i) {
      const Vec2<float> u = is_delta(scene.light(i)) ? Vec2<float>(0) : sampler.next_2d();
      const auto light = scene.light(i).sample(at.surface.position, u);
      if (light) sum += reflected(scene, at, wo, *light) * (fade(*light) / light->pdf);
    }
    return sum;
  }

  /// What turns the inverse square that a sample already has into the law asked for.
  [[nodiscard]] float fade(const LightSample& light) const noexcept {
    if (falloff == Falloff::InverseSquare || !light.is_delta || !(light.distance < infinity<float>)) return 1;
    const float squared = light.distance * light.distance;
    return falloff == Falloff::None ? squared : squared * squared;
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>

#include <glint/color/rgb.hpp>
#include <glint/light/concepts.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/interaction.hpp>

namespace glint {

/// True where nothing stands between a surface and the end of a light sample.
template <SceneLike S, Bsdf B>
[[nodiscard]] bool is_lit(const S& scene, const Interaction<B>& at, const LightSample& light) {
  const Ray<float> shadow = std::isfinite(light.distance) ? at.leave_to(light.target) : at.leave(light.wi);
  return !scene.occluded(shadow);
}

/// What one light sample adds to the radiance leaving a surface, before its probability is divided out: BSDF, cosine,
/// radiance and visibility. The shadow ray is cast only where the rest is not black.
template <SceneLike S, Bsdf B>
[[nodiscard]] Rgb reflected(const S& scene, const Interaction<B>& at, const Vec3<float>& wo_local,
                            const LightSample& light) {
  const Rgb value = at.bsdf.evaluate(wo_local, at.to_local(light.wi)) * light.radiance;
  return is_black(value) || !is_lit(scene, at, light) ? Rgb{} : value;
}

}  // namespace glint

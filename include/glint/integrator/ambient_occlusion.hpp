// SPDX-License-Identifier: MIT
#pragma once
#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/warp.hpp>

namespace glint {

/// The share of the hemisphere above a surface, weighted by the cosine, that is open up to a distance: 1 is white. A
/// surface is open on the side it is seen from. Where there is nothing, it is white, too.
///
/// Source: Zhukov, Iones & Kronin, "An Ambient Light Illumination Model" (EGWR 1998).
struct AmbientOcclusion {
  float distance = infinity<float>;  ///< what is farther away hides nothing

  template <SceneLike S, Sampler R>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& sampler) const {
    const auto at = scene.interact(ray);
    if (!at) return Rgb{1};
    Vec3<float> local = cosine_hemisphere(sampler.next_2d());
    if (glm::dot(at->wo, at->frame.z) < 0) local.z = -local.z;
    Ray<float> probe = at->leave(at->to_world(local));
    probe.t_max = distance;
    return scene.occluded(probe) ? Rgb{} : Rgb{1};
  }
};

}  // namespace glint

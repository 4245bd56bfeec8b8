// SPDX-License-Identifier: MIT
#pragma once
#include <glint/color/rgb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/integrator/concepts.hpp>

namespace glint {

/// Shows the shading normals of what the camera sees: each component in [−1, 1] becomes red, green, blue in [0, 1].
/// Where there is nothing, it is black.
struct Normals {
  template <SceneLike S, Sampler R>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& /*sampler*/) const {
    const auto at = scene.interact(ray);
    if (!at) return {};
    const Vec3<float>& n = at->frame.z;
    return {0.5F + 0.5F * n.x, 0.5F + 0.5F * n.y, 0.5F + 0.5F * n.z};
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/color/rgb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>

namespace glint {

/// An estimate of the radiance that arrives along a ray: `radiance(scene, ray, sampler)`. Its randomness comes from the
/// sampler alone, and it keeps no state, so that one integrator serves all threads.
template <typename I, typename S, typename R>
concept IntegratorFor = SceneLike<S> && Sampler<R> &&
    requires(const I& integrator, const S& scene, const Ray<float>& ray, R& sampler) {
  { integrator.radiance(scene, ray, sampler) } -> std::same_as<Rgb>;
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/camera/concepts.hpp>
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

/// An integrator that first looks at the scene: `prepare(scene)`, once a rendering, gives what does the work.
template <typename I, typename S>
concept PreparableIntegrator = SceneLike<S> && requires(const I& integrator, const S& scene) {
  integrator.prepare(scene);
};

/// What takes splats: `splat(film, value)` adds to the pixel at a film position in [0, 1)². Of the paths that bring
/// them there are as many as camera paths; a pixel gets the sum over one path for each pixel.
struct DiscardSplats {
  void operator()(const Vec2<float>& /*film*/, const Rgb& /*value*/) const noexcept {}
};

/// An integrator that also brings light to pixels it did not start from: besides what it returns, as IntegratorFor
/// does, it may call `splat` any number of times: `radiance(scene, ray, sampler, camera, splat)`. The camera is a
/// RayGenerator, see camera/importance.hpp for what it can be asked.
template <typename I, typename S, typename R, typename G, typename Splat = DiscardSplats>
concept SplattingIntegratorFor = SceneLike<S> && Sampler<R> && RayGenerator<G> &&
    requires(const I& integrator, const S& scene, const Ray<float>& ray, R& sampler, const G& camera,
             const Splat& splat) {
  { integrator.radiance(scene, ray, sampler, camera, splat) } -> std::same_as<Rgb>;
};

/// The prepared integrator; the integrator itself where there is nothing to prepare.
template <typename I, SceneLike S>
[[nodiscard]] decltype(auto) prepared(const I& integrator, const S& scene) {
  if constexpr (PreparableIntegrator<I, S>) {
    return integrator.prepare(scene);
  } else {
    return (integrator);
  }
}

}  // namespace glint

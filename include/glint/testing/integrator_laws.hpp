// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

/// A mean of samples, and its standard error.
struct Estimate {
  double mean = 0;
  double error = 0;
};

/// The luminance along a ray, from independent samples.
template <typename I, SceneLike S>
  requires IntegratorFor<I, S, IndependentSampler>
[[nodiscard]] Estimate estimate_radiance(const I& integrator, const S& scene, const Ray<float>& ray, int samples,
                                         std::uint32_t seed) {
  const Independent sequence{.seed = seed};
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < samples; ++i) {
    auto sampler = sequence.stream({0, 0}, i);
    const auto value = static_cast<double>(luminance(integrator.radiance(scene, ray, sampler)));
    sum += value;
    squares += value * value;
  }
  const double mean = sum / samples;
  return {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)};
}

/// What an integrator breaks of the laws of IntegratorFor, on some rays into a scene, a sentence each; nothing where it
/// keeps them all.
///
/// - Equal numbers give equal radiance: it keeps no state, and has no randomness of its own.
/// - Radiance is finite and not negative.
template <SceneLike S, IntegratorFor<S, IndependentSampler> I>
[[nodiscard]] std::vector<std::string> violations_of_integrator_laws(const I& integrator, const S& scene,
                                                                     const std::vector<Ray<float>>& rays,
                                                                     std::uint32_t seed) {
  Violations violations;
  const Independent sequence{.seed = seed};
  for (int i = 0; const Ray<float>& ray : rays) {
    auto first = sequence.stream({0, 0}, i);
    auto second = sequence.stream({0, 0}, i++);
    const Rgb radiance = integrator.radiance(scene, ray, first);
    violations.expect(radiance == integrator.radiance(scene, ray, second), "equal numbers give equal radiance", ray);
    violations.expect(is_finite(radiance), "radiance is finite", ray);
    violations.expect(radiance.r >= 0 && radiance.g >= 0 && radiance.b >= 0, "radiance is not negative", ray);
  }
  return violations.take();
}

/// Where an integrator and an oracle, slow but sure, estimate different radiance: a sentence for the first such ray.
///
/// Requires: both estimate the same light; samples enough that both have met what matters.
/// Errors:   right ones are accused once in fifteen thousand rays: their means are four standard errors apart.
template <SceneLike S, IntegratorFor<S, IndependentSampler> I, IntegratorFor<S, IndependentSampler> Oracle>
[[nodiscard]] std::vector<std::string> violations_of_agreement(const I& integrator, const Oracle& oracle,
                                                               const S& scene, const std::vector<Ray<float>>& rays,
                                                               int samples, std::uint32_t seed) {
  Violations violations;
  for (const Ray<float>& ray : rays) {
    const Estimate found = estimate_radiance(integrator, scene, ray, samples, seed);
    const Estimate expected = estimate_radiance(oracle, scene, ray, samples, seed + 1);
    const double allowed = 4 * std::hypot(found.error, expected.error) + 1e-5 * expected.mean;
    violations.expect(std::abs(found.mean - expected.mean) <= allowed, "the mean is the oracle's", found.mean,
                      expected.mean);
  }
  return violations.take();
}

}  // namespace glint::testing

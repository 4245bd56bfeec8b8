// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

namespace detail {

[[nodiscard]] inline bool nearly(float a, float b, float relative) noexcept {
  return std::abs(a - b) <= relative * std::max(std::abs(a), std::abs(b));
}

/// The laws of one sample.
template <Light L>
void check_light_sample(const L& light, const Vec3<float>& from, const LightSample& sample, Violations& violations) {
  const auto expect = [&](bool kept, const char* law) { violations.expect(kept, law, from, sample.wi); };
  expect(std::abs(glm::length(sample.wi) - 1) < 1e-5F, "wi has unit length");
  expect(sample.pdf > 0, "the density of a sample is above 0");
  expect(is_finite(sample.radiance) && sample.radiance.r >= 0 && sample.radiance.g >= 0 && sample.radiance.b >= 0,
         "radiance is finite and not negative");
  expect(sample.distance > 0, "a light is at some distance");
  if (std::isfinite(sample.distance)) {
    const Vec3<float> gap = from + sample.wi * sample.distance - sample.target;
    expect(glm::length(gap) <= 1e-4F * (sample.distance + glm::length(from)), "the target is where wi leads to");
  } else if (!sample.is_delta) {
    expect(nearly(background_pdf(light, sample.wi), sample.pdf, 1e-3F), "pdf(wi) is the density that sample states");
    const Rgb seen = background(light, sample.wi);
    expect(nearly(luminance(seen), luminance(sample.radiance), 1e-2F), "background(wi) is the radiance of the sample");
  }
}

}  // namespace detail

/// The laws of Light that `light` breaks, as seen from a point: a sentence each, none where all hold.
///
/// - Samples have a unit direction, a positive density, finite radiance, and a target where the direction leads to.
/// - For a light at infinity, pdf and background agree with the samples, and the irradiance estimated by its samples
///   is the one estimated by uniform directions.
template <Light L>
[[nodiscard]] std::vector<std::string> violations_of_light_laws(const L& light, const Vec3<float>& from,
                                                                std::uint64_t seed) {
  Violations violations;
  Random random{seed};
  constexpr int samples = 4000;
  double by_light = 0;
  double by_direction = 0;
  for (int i = 0; i < samples; ++i) {
    const auto sample = light.sample(from, random.uniform_vec2());
    if (sample) {
      detail::check_light_sample(light, from, *sample, violations);
      by_light += static_cast<double>(luminance(sample->radiance) / sample->pdf) / samples;
    }
    const Vec3<float> direction = uniform_sphere(random.uniform_vec2());
    by_direction += static_cast<double>(luminance(background(light, direction)) * 4 * pi<float>) / samples;
  }
  if constexpr (InfiniteLight<L>) {
    violations.expect(std::abs(by_light - by_direction) <= 0.2 * by_direction, "samples carry the light's irradiance",
                      by_light, by_direction);
  }
  return violations.take();
}

}  // namespace glint::testing

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
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

/// A mean and its standard error.
class Mean {
 public:
  void add(double value) noexcept {
    ++count_;
    sum_ += value;
    squares_ += value * value;
  }
  [[nodiscard]] double mean() const noexcept { return sum_ / count_; }
  [[nodiscard]] double error() const noexcept {
    return std::sqrt(std::max(0.0, squares_ / count_ - mean() * mean()) / count_);
  }

 private:
  int count_ = 0;
  double sum_ = 0;
  double squares_ = 0;
};

inline void expect_same_mean(const Mean& a, const Mean& b, const char* law, Violations& violations) {
  const double error = 5 * std::hypot(a.error(), b.error()) + 1e-3 * std::max(std::abs(a.mean()), std::abs(b.mean()));
  violations.expect(std::abs(a.mean() - b.mean()) <= error, law, a.mean(), b.mean());
}

/// What is found in the direction of a sample. Next to the light's border nothing may be, for rounding; where the light
/// is seen at a grazing angle, its density changes too fast to be compared.
template <SurfaceLight L, typename Find>
void check_found_surface(const L& light, const Find& find, const Vec3<float>& from, const LightSample& sample,
                         Violations& violations) {
  const std::optional<Surface> met = find(Ray<float>{.origin = from, .direction = sample.wi});
  if (!met || !(-glm::dot(met->normal, sample.wi) > 0.02F)) return;
  const auto expect = [&](bool kept, const char* law) { violations.expect(kept, law, from, sample.wi); };
  expect(nearly(light.pdf(from, *met), sample.pdf, 1e-2F), "pdf(from, at) is the density that sample states");
  const Rgb seen = light.emission(*met, -sample.wi);
  expect(nearly(luminance(seen), luminance(sample.radiance), 1e-2F), "emission(at, -wi) is the radiance of the sample");
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

/// The laws of SurfaceLight that `light` breaks, as seen from a point. `find(ray)` is the light's surface where a ray
/// meets it, or nothing.
///
/// - What a sample says of radiance and density, emission and pdf say of the surface found in its direction.
/// - The density integrates over all directions to the chance of a sample.
/// - The irradiance by samples is the one by uniform directions. Both within five standard errors.
///
/// Requires: `from` sees the light in a good part of all directions, a hundredth or more.
template <SurfaceLight L, typename Find>
[[nodiscard]] std::vector<std::string> violations_of_surface_light_laws(const L& light, const Find& find,
                                                                        const Vec3<float>& from, std::uint64_t seed) {
  Violations violations;
  Random random{seed};
  constexpr int samples = 20'000;
  detail::Mean chance;
  detail::Mean density;
  detail::Mean by_light;
  detail::Mean by_direction;
  for (int i = 0; i < samples; ++i) {
    const auto sample = light.sample(from, random.uniform_vec2());
    chance.add(sample ? 1 : 0);
    by_light.add(sample ? static_cast<double>(luminance(sample->radiance) / sample->pdf) : 0);
    if (sample) {
      detail::check_light_sample(light, from, *sample, violations);
      detail::check_found_surface(light, find, from, *sample, violations);
    }
    const Vec3<float> w = uniform_sphere(random.uniform_vec2());
    const std::optional<Surface> met = find(Ray<float>{.origin = from, .direction = w});
    density.add(met ? static_cast<double>(light.pdf(from, *met)) * 4 * pi<double> : 0);
    by_direction.add(met ? static_cast<double>(luminance(light.emission(*met, -w))) * 4 * pi<double> : 0);
  }
  detail::expect_same_mean(density, chance, "the density integrates to the chance of a sample", violations);
  detail::expect_same_mean(by_light, by_direction, "samples carry the light's irradiance", violations);
  return violations.take();
}

namespace detail {

/// Whether emission_pdf says this density of a direction, or less and more of those that rounding may have put it
/// between: the density of an environment jumps from cell to cell, and grows without bounds toward its poles.
template <EmittingLight L>
[[nodiscard]] bool has_density(const L& light, const Surface& at, const Vec3<float>& w, const Aabb<float>& scene,
                               float density) {
  constexpr float beside = 4e-6F;
  float least = infinity<float>;
  float most = 0;
  for (int i = 0; i < 7; ++i) {
    Vec3<float> shift(0.0F);
    if (i != 0) shift[(i - 1) / 2] = i % 2 == 0 ? beside : -beside;
    const float there = light.emission_pdf(at, glm::normalize(w + shift), scene).direction;
    least = std::min(least, there);
    most = std::max(most, there);
  }
  return least * 0.999F <= density && density <= most * 1.001F;
}

}  // namespace detail

/// The laws of EmittingLight that `light` breaks in a scene of these bounds.
///
/// - Rays have unit directions and positive densities, which emission_pdf says too.
/// - Their mean flux is the luminance of power(scene), within five standard errors and a thousandth.
template <EmittingLight L>
[[nodiscard]] std::vector<std::string> violations_of_emission_laws(const L& light, const Aabb<float>& scene,
                                                                   std::uint64_t seed) {
  Violations violations;
  Random random{seed};
  constexpr int samples = 20'000;
  detail::Mean flux;
  for (int i = 0; i < samples; ++i) {
    const Vec2<float> u_position = random.uniform_vec2();
    const auto out = light.emit(u_position, random.uniform_vec2(), scene);
    if (!out) {
      flux.add(0);
      continue;
    }
    const Vec3<float>& w = out->ray.direction;
    const auto expect = [&](bool kept, const char* law) { violations.expect(kept, law, out->ray); };
    expect(std::abs(glm::length(w) - 1) < 1e-5F, "the direction of a ray has unit length");
    expect(out->pdf.position > 0 && out->pdf.direction > 0, "the densities of a ray are above 0");
    const Surface at{.position = out->ray.origin, .normal = out->normal};
    const EmissionPdf pdf = light.emission_pdf(at, w, scene);
    expect(detail::nearly(pdf.position, out->pdf.position, 1e-3F), "emission_pdf is the density of the position");
    expect(detail::has_density(light, at, w, scene, out->pdf.direction),
           "emission_pdf is the density of the direction");
    const float cosine = std::abs(glm::dot(out->normal, w));
    flux.add(static_cast<double>(luminance(out->radiance) * cosine / (out->pdf.position * out->pdf.direction)));
  }
  const auto power = static_cast<double>(luminance(light.power(scene)));
  violations.expect(std::abs(flux.mean() - power) <= 5 * flux.error() + 1e-3 * power,
                    "the rays carry the light's power", flux.mean(), power);
  return violations.take();
}

}  // namespace glint::testing

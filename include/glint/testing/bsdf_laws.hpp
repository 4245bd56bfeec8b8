// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>
#include <glint/testing/chi_square.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

/// From where a BSDF is not black.
enum class SeenFrom : std::uint8_t {
  Anywhere,  ///< perhaps from both sides: nothing is asked
  Front      ///< from the normal's side alone
};

/// What the laws cannot find out by themselves.
struct BsdfLawOptions {
  SeenFrom seen_from = SeenFrom::Anywhere;
  float least_albedo = 0;   ///< one for a BSDF that loses no light: the white furnace
  float radiance_eta = 1;   ///< index inside / outside by whose square transmitted radiance is scaled; one: it is not
  float tolerance = 1e-3F;  ///< relative, of values computed in two ways; narrow lobes round more
  int samples = 4096;       ///< for each of the directions whose albedo is measured
};

namespace detail {

/// One BSDF on trial.
template <Bsdf B>
class BsdfTrial {
 public:
  BsdfTrial(const B& bsdf, std::uint64_t seed, const BsdfLawOptions& options)
      : bsdf_(bsdf), options_(options), seed_(seed), random_(seed) {}

  [[nodiscard]] std::vector<std::string> run() {
    for (const Vec3<float>& wo : extreme_directions()) {
      check_extreme_samples(wo);
      for (const Vec3<float>& wi : extreme_directions()) check_pair(wo, wi);
    }
    for (int i = 0; i < 1000; ++i) {
      const Vec3<float> wo = direction();
      const float u = random_.uniform<float>();
      check_sample(wo, u, random_.uniform_vec2());
      check_pair(wo, direction());
    }
    for (int i = 0; i < albedos_; ++i) check_albedo(direction());
    for (const float side : {1.0F, -1.0F}) {
      check_albedo({0.0F, 0.0F, side});
      check_albedo({std::sqrt(1.0F - 1e-4F), 0.0F, 0.01F * side});
    }
    if (!bsdf_.is_specular()) check_distribution();
    return violations_.take();
  }

 private:
  /// The poles, the plane of the surface, and close to it on either side.
  [[nodiscard]] static std::vector<Vec3<float>> extreme_directions() {
    std::vector<Vec3<float>> result{{0.0F, 0.0F, 1.0F}, {0.0F, 0.0F, -1.0F}};
    for (const float z : {0.0F, -0.0F, 1e-6F, -1e-6F, 1e-3F, -1e-3F}) {
      const float r = std::sqrt(1.0F - z * z);
      for (const Vec3<float>& w :
           {Vec3<float>{r, 0.0F, z}, Vec3<float>{-r, 0.0F, z}, Vec3<float>{0.0F, r, z}, Vec3<float>{0.0F, -r, z}}) {
        result.push_back(w);
      }
    }
    return result;
  }

  [[nodiscard]] Vec3<float> direction() { return uniform_sphere(random_.uniform_vec2()); }

  [[nodiscard]] bool is_black_from(const Vec3<float>& wo) const {
    return options_.seen_from == SeenFrom::Front && !(wo.z > 0.0F);
  }

  /// The squared index of the medium that w is in, as far as radiance is scaled by it.
  [[nodiscard]] float squared_index(const Vec3<float>& w) const {
    return w.z > 0.0F ? 1.0F : options_.radiance_eta * options_.radiance_eta;
  }

  /// Takes the scaling of radiance back: what remains of a weight is the share of power.
  [[nodiscard]] float power_per_radiance(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return squared_index(wi) / squared_index(wo);
  }

  [[nodiscard]] bool agree(float a, float b, float tolerance) const {
    return std::abs(a - b) <= tolerance * std::max(std::abs(a), std::abs(b)) + std::numeric_limits<float>::min();
  }
  [[nodiscard]] bool agree(const Rgb& a, const Rgb& b, float tolerance) const {
    return agree(a.r, b.r, tolerance) && agree(a.g, b.g, tolerance) && agree(a.b, b.b, tolerance);
  }
  [[nodiscard]] static bool is_sound(const Rgb& c) { return is_finite(c) && c.r >= 0 && c.g >= 0 && c.b >= 0; }

  void check_extreme_samples(const Vec3<float>& wo) {
    constexpr std::array ends{0.0F, 0.5F, one_minus_epsilon<float>};
    for (const float u : ends) {
      for (const float x : ends) {
        for (const float y : ends) check_sound(wo, bsdf_.sample(wo, u, Vec2<float>{x, y}));
      }
    }
  }

  void check_sound(const Vec3<float>& wo, const std::optional<BsdfSample>& s) {
    if (!s) return;
    violations_.expect(!is_black_from(wo), "nothing is sampled from behind", wo, s->wi);
    violations_.expect(std::abs(length_squared(s->wi) - 1.0F) < 1e-5F, "sampled directions have unit length", wo,
                       s->wi);
    violations_.expect(is_sound(s->weight), "weights are finite and not negative", wo, s->wi);
    violations_.expect(s->pdf > 0.0F && std::isfinite(s->pdf), "densities of samples are finite and positive", wo,
                       s->wi);
    if (s->lobe == Lobe::Specular) {
      violations_.expect(s->pdf <= 1.0F, "specular lobes are chosen with a chance of at most one", wo, s->wi);
    } else {
      violations_.expect(!bsdf_.is_specular(), "specular BSDFs have specular lobes alone", wo, s->wi);
    }
  }

  void check_sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) {
    const auto s = bsdf_.sample(wo, u, uv);
    check_sound(wo, s);
    if (!s) return;
    if (s->lobe == Lobe::Specular) {
      check_way_back(wo, *s);
      return;
    }
    violations_.expect(agree(s->pdf, bsdf_.pdf(wo, s->wi), options_.tolerance), "pdf is the density of the sample", wo,
                       s->wi);
    violations_.expect(agree(s->weight * s->pdf, bsdf_.evaluate(wo, s->wi), options_.tolerance),
                       "weight is evaluate over pdf", wo, s->wi);
  }

  void check_pair(const Vec3<float>& wo, const Vec3<float>& wi) {
    const Rgb value = bsdf_.evaluate(wo, wi);
    const float pdf = bsdf_.pdf(wo, wi);
    violations_.expect(is_sound(value), "values are finite and not negative", wo, wi);
    violations_.expect(pdf >= 0.0F && std::isfinite(pdf), "densities are finite and not negative", wo, wi);
    violations_.expect(!bsdf_.is_specular() || (is_black(value) && pdf == 0.0F),
                       "specular BSDFs evaluate to zero, with density zero", wo, wi);
    violations_.expect(!is_black_from(wo) || (is_black(value) && pdf == 0.0F),
                       "from behind, values and densities are zero", wo, wi);
    if (std::min(std::abs(wo.z), std::abs(wi.z)) < 0.01F) return;
    violations_.expect(is_black(value) || pdf > 0.0F, "where light is scattered, samples may go", wo, wi);
    const Rgb there = value * (squared_index(wi) / std::abs(wi.z));
    const Rgb back = bsdf_.evaluate(wi, wo) * (squared_index(wo) / std::abs(wo.z));
    violations_.expect(agree(there, back, options_.tolerance), "light goes both ways alike", wo, wi);
  }

  /// Reciprocity of a specular lobe: of the directions sampled at wi, the one back to wo carries as much. Where a
  /// direction grazes, the other follows it too steeply to be compared.
  void check_way_back(const Vec3<float>& wo, const BsdfSample& s) {
    if (std::min(std::abs(wo.z), std::abs(s.wi.z)) < 0.05F) return;
    for (const float u : {0.0F, 0.25F, 0.5F, 0.75F, one_minus_epsilon<float>}) {
      const auto back = bsdf_.sample(s.wi, u, Vec2<float>{0.5F});
      if (!back || back->lobe != Lobe::Specular || length_squared(back->wi - wo) > 1e-8F) continue;
      const Rgb there_power = s.weight * (s.pdf * power_per_radiance(wo, s.wi));
      const Rgb back_power = back->weight * (back->pdf * power_per_radiance(s.wi, wo));
      violations_.expect(agree(there_power, back_power, options_.tolerance), "specular light goes both ways alike", wo,
                         s.wi);
      return;
    }
    violations_.expect(is_black(s.weight), "a specular direction leads back", wo, s.wi);
  }

  /// The power that leaves for a unit of power that arrives: radiance scaled at the interface is scaled back.
  void check_albedo(const Vec3<float>& wo) {
    double sum = 0;
    double sum_of_squares = 0;
    for (int i = 0; i < options_.samples; ++i) {
      const float u = random_.uniform<float>();
      const auto s = bsdf_.sample(wo, u, random_.uniform_vec2());
      if (!s) continue;
      const double power = double{max_component(s->weight)} * double{power_per_radiance(wo, s->wi)};
      sum += power;
      sum_of_squares += power * power;
    }
    const double albedo = sum / options_.samples;
    const double variance = std::max(0.0, sum_of_squares / options_.samples - albedo * albedo);
    const double margin = 1e-4 + 5 * std::sqrt(variance / options_.samples);
    violations_.expect(albedo <= 1 + margin, "no more light leaves than arrives", albedo, 1);
    if (is_black_from(wo)) return;
    violations_.expect(albedo >= options_.least_albedo - margin, "no less light leaves than promised", albedo,
                       options_.least_albedo);
  }

  void check_distribution() {
    for (int i = 0; i < distributions_; ++i) {
      const Vec3<float> wo = direction();
      const auto sample = [&](float u, const Vec2<float>& uv) -> std::optional<Vec3<float>> {
        const auto s = bsdf_.sample(wo, u, uv);
        return s && s->lobe != Lobe::Specular ? std::optional(s->wi) : std::nullopt;
      };
      const auto pdf = [&](const Vec3<float>& wi) { return bsdf_.pdf(wo, wi); };
      const auto result = chi_square_sphere(sample, pdf,
                                            {.samples = 20'000,
                                             .seed = mix(seed_, static_cast<std::uint64_t>(i)),
                                             .significance = 1e-5,
                                             .tests = distributions_});
      violations_.expect(result.passed, "samples are distributed as pdf says", result.message);
    }
  }

  static constexpr int albedos_ = 4;
  static constexpr int distributions_ = 4;

  const B& bsdf_;
  BsdfLawOptions options_;
  std::uint64_t seed_;
  Random random_;
  Violations violations_;
};

}  // namespace detail

/// The laws of the concept Bsdf that the value breaks, one sentence each; none for a sound one.
///
/// Everything is finite, also for grazing directions and random numbers at the ends of their range; weights are value
/// over density; samples are distributed as the density says; light goes both ways alike; no more leaves than arrives.
///
/// Cost: some 10⁵ evaluations and samples.
template <Bsdf B>
[[nodiscard]] std::vector<std::string> violations_of_bsdf_laws(const B& bsdf, std::uint64_t seed,
                                                               const BsdfLawOptions& options = {}) {
  return detail::BsdfTrial<B>(bsdf, seed, options).run();
}

}  // namespace glint::testing

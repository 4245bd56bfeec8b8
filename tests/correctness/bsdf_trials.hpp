// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/oren_nayar.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/bsdf/thin_dielectric.hpp>
#include <glint/bsdf/two_sided.hpp>
#include <glint/testing/bsdf_laws.hpp>

/// Every BSDF before the laws of testing/bsdf_laws.hpp.
namespace correctness {

using glint::testing::BsdfLawOptions;
using glint::testing::SeenFrom;

struct BsdfTrials {
  std::uint64_t seeds = 1;
  bool all_hold = true;

  /// One line of the table: how often all laws held, each time with other directions.
  template <glint::Bsdf B>
  void operator()(const std::string& name, const std::string& furnace, const B& bsdf, const BsdfLawOptions& options) {
    std::size_t held = 0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      const auto broken = glint::testing::violations_of_bsdf_laws(bsdf, seed, options);
      held += broken.empty() ? 1U : 0U;
      for (const std::string& one : broken) std::fprintf(stderr, "%s: %s\n", name.c_str(), one.c_str());
    }
    all_hold = all_hold && held == seeds;
    std::printf("| %s | %s | %zu of %zu |\n", name.c_str(), furnace.c_str(), held, std::size_t(seeds));
  }
};

/// Prints the table, and says whether all laws hold.
[[nodiscard]] inline bool try_bsdfs(std::uint64_t seeds) {
  using namespace glint;
  std::printf(
      "\n### BSDFs\n\nReciprocity, weight = evaluate / pdf, samples against their density (χ²), the density's "
      "integral, "
      "energy ≤ 1, and where a BSDF should lose nothing, the white furnace.\n\n");
  std::printf("| BSDF | white furnace, at least | trials in which all laws held |\n|---|---|---|\n");
  BsdfTrials trials{seeds};
  const auto front = SeenFrom::Front;
  trials("Lambertian", "1", Lambertian{Rgb{1}}, {.seen_from = front, .least_albedo = 1});
  trials("OrenNayar, roughness 0.7", "1", OrenNayar{Rgb{1}, 0.7F}, {.seen_from = front, .least_albedo = 1});
  trials("Mirror", "1", Mirror{}, {.seen_from = front, .least_albedo = 1});
  trials("TwoSided&lt;Lambertian&gt;", "1", TwoSided{Lambertian{Rgb{1}}}, {.least_albedo = 1});
  trials("PerfectRefraction, η = 1.5", "1", PerfectRefraction{1.5F}, {.least_albedo = 1});
  trials("Dielectric, η = 1.5", "1", Dielectric{.eta = 1.5F}, {.least_albedo = 1, .radiance_eta = 1.5F});
  trials("ThinDielectric, η = 1.5", "1", ThinDielectric{.eta = 1.5F}, {.least_albedo = 1});
  trials("Conductor", "", Conductor{}, {.seen_from = front});
  const BsdfLawOptions rough{.seen_from = front, .tolerance = 5e-3F};
  trials("RoughConductor&lt;Beckmann&gt;, α = 0.3 × 0.6", "",
         RoughConductor<Beckmann>{.distribution = {0.3F, 0.6F}, .eta = Rgb{1}, .k = Rgb{2}}, rough);
  trials("RoughConductor&lt;Ggx&gt;, α = 0.3 × 0.6", "",
         RoughConductor<Ggx>{.distribution = {0.3F, 0.6F}, .eta = Rgb{1}, .k = Rgb{2}}, rough);
  const BsdfLawOptions frosted{.radiance_eta = 1.5F, .tolerance = 5e-3F};
  trials("RoughDielectric&lt;Beckmann&gt;, α = 0.3", "", RoughDielectric<Beckmann>{.distribution = {0.3F, 0.3F}},
         frosted);
  trials("RoughDielectric&lt;Ggx&gt;, α = 0.3", "", RoughDielectric<Ggx>{.distribution = {0.3F, 0.3F}}, frosted);
  return trials.all_hold;
}

}  // namespace correctness

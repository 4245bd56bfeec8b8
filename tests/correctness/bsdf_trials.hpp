// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include <glint/bsdf/blend.hpp>
#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/bsdf/compensated.hpp>
#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/oren_nayar.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/bsdf/perturbed.hpp>
#include <glint/bsdf/principled.hpp>
#include <glint/bsdf/rough_coated_diffuse.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/bsdf/sheen.hpp>
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

/// Coats over something diffuse, and fuzz.
inline void try_layers(BsdfTrials& trials) {
  using namespace glint;
  BsdfLawOptions front{.seen_from = SeenFrom::Front, .least_albedo = 0.9999F};
  trials("CoatedDiffuse, η = 1.5", "0.9999", CoatedDiffuse{Rgb{1}, 1.5F}, front);
  front.tolerance = 5e-3F;
  front.least_albedo = 0.98F;
  trials("RoughCoatedDiffuse&lt;Ggx&gt;, α = 0.25", "0.98", RoughCoatedDiffuse<Ggx>{Rgb{1}, {0.25F, 0.25F}, 1.5F},
         front);
  front.least_albedo = 0;
  trials("RoughCoatedDiffuse&lt;Beckmann&gt;, α = 0.4", "",
         RoughCoatedDiffuse<Beckmann>{{0.8F, 0.4F, 0.1F}, {0.4F, 0.4F}, 1.5F}, front);
  trials("Sheen, roughness 0.5", "", Sheen{.roughness = 0.5F}, front);
}

/// BSDFs made of others.
inline void try_compositions(BsdfTrials& trials) {
  using namespace glint;
  const auto front = SeenFrom::Front;
  const RoughConductor<Ggx> metal{.distribution = {0.5F, 0.5F}};
  trials("TwoSided&lt;Lambertian&gt;", "1", TwoSided{Lambertian{Rgb{1}}}, {.least_albedo = 1});
  trials("Compensated&lt;RoughConductor&lt;Ggx&gt;&gt;, α = 0.5", "", Compensated{metal},
         {.seen_from = front, .tolerance = 5e-3F});
  trials("Blend of Mirror and Lambertian", "1", Blend{Mirror{}, Lambertian{Rgb{1}}, 0.6F},
         {.seen_from = front, .least_albedo = 1});
  trials("Blend of Lambertian and Dielectric", "", Blend{Lambertian{Rgb{0.5F}}, Dielectric{}, 0.9F},
         {.radiance_eta = 1.5F});
  trials("Perturbed&lt;Lambertian&gt;, by 53° (normal and bump maps)", "",
         Perturbed{Lambertian{Rgb{1}}, {-0.48F, 0.64F, 0.6F}}, {.seen_from = front});
  trials("Perturbed&lt;RoughConductor&lt;Ggx&gt;&gt;, by 16°", "", Perturbed{metal, {0.0F, -0.28F, 0.96F}},
         {.seen_from = front, .tolerance = 5e-3F});
}

/// One for each part of `Principled`, and of all at once.
inline void try_principled(BsdfTrials& trials) {
  using glint::Principled;
  const BsdfLawOptions front{.seen_from = SeenFrom::Front, .tolerance = 5e-3F};
  BsdfLawOptions white = front;
  white.least_albedo = 0.98F;
  const BsdfLawOptions through{.radiance_eta = 1.5F, .tolerance = 5e-3F};
  const glint::Rgb color{0.9F, 0.5F, 0.1F};
  trials("Principled, opaque and white", "0.98", Principled{.base_color = glint::Rgb{1}}, white);
  trials("Principled, metal, anisotropic", "",
         Principled{.base_color = color, .metallic = 1, .roughness = 0.5F, .anisotropy = 0.6F}, front);
  trials("Principled, glass", "", Principled{.base_color = color, .roughness = 0.4F, .transmission = 1}, through);
  trials("Principled, half metal under a coat", "",
         Principled{.base_color = color, .metallic = 0.5F, .coat = 1, .coat_roughness = 0.3F}, front);
  trials("Principled, velvet", "",
         Principled{.base_color = color, .roughness = 0.9F, .sheen = 1, .sheen_roughness = 0.6F, .sheen_tint = 0.5F},
         front);
  trials("Principled, everything at once", "",
         Principled{.base_color = color,
                    .metallic = 0.3F,
                    .roughness = 0.4F,
                    .anisotropy = 0.3F,
                    .transmission = 0.5F,
                    .coat = 0.5F,
                    .coat_roughness = 0.3F,
                    .sheen = 0.5F},
         through);
}

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
  try_layers(trials);
  try_compositions(trials);
  try_principled(trials);
  return trials.all_hold;
}

}  // namespace correctness

// SPDX-License-Identifier: MIT
#include <glint/bsdf/metals.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>

#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/rough_conductor.hpp>

namespace test_bsdf_metals {

using glint::Metal;
using glint::Rgb;
namespace metals = glint::metals;

namespace {

/// What the metal reflects straight on.
Rgb reflectance(const Metal& metal) {
  return glint::fresnel_conductor(1.0F, metal.eta, metal.k);
}

}  // namespace

TEST_CASE("metals: straight on they have their colors", "[bsdf][metals]") {
  // Linear Rec. 709 from whole spectra, of other samples in part. Iron and titanium: the guide to materials of
  // Filament, 8-bit (192, 189, 186) and (206, 200, 194) decoded; the others: Akenine-Möller et al., Real-Time Rendering
  // (2018), table 9.2, cut off at one.
  struct Published {
    std::string name;
    Metal metal;
    Rgb color;
  };
  for (const auto& [name, metal, color] : {Published{"aluminum", metals::aluminum, {0.913F, 0.922F, 0.924F}},
                                           Published{"chromium", metals::chromium, {0.549F, 0.556F, 0.554F}},
                                           Published{"copper", metals::copper, {0.955F, 0.638F, 0.538F}},
                                           Published{"gold", metals::gold, {1.000F, 0.782F, 0.344F}},
                                           Published{"iron", metals::iron, {0.527F, 0.509F, 0.491F}},
                                           Published{"silver", metals::silver, {0.972F, 0.960F, 0.915F}},
                                           Published{"titanium", metals::titanium, {0.617F, 0.578F, 0.539F}},
                                           Published{"tungsten", metals::tungsten, {0.504F, 0.498F, 0.478F}}}) {
    CAPTURE(name);
    const Rgb ours = reflectance(metal);
    CHECK(ours.r == Approx(color.r).margin(0.07));
    CHECK(ours.g == Approx(color.g).margin(0.07));
    CHECK(ours.b == Approx(color.b).margin(0.07));
  }
}

TEST_CASE("metals: gold and copper reflect more red than green, and more green than blue", "[bsdf][metals]") {
  for (const Metal& metal : {metals::gold, metals::copper}) {
    const Rgb color = reflectance(metal);
    CHECK(color.r > color.g);
    CHECK(color.g > color.b);
  }
}

TEST_CASE("metals: they make conductors, smooth and rough, of which aluminum is the default", "[bsdf][metals]") {
  constexpr glint::Conductor gold{.eta = metals::gold.eta, .k = metals::gold.k};
  constexpr glint::RoughConductor<glint::Ggx> rough{.eta = metals::gold.eta, .k = metals::gold.k};
  CHECK(gold.eta == rough.eta);
  CHECK(glint::Conductor{} == glint::Conductor{.eta = metals::aluminum.eta, .k = metals::aluminum.k});
  CHECK(glint::RoughConductor<glint::Ggx>{}.k == metals::aluminum.k);
}

TEST_CASE("metals: a metal of a color reflects it straight on", "[bsdf][metals]") {
  const Rgb color{0.95F, 0.5F, 0.02F};
  const Metal metal = glint::metal_of_color(color);
  const Rgb seen = glint::fresnel_conductor(1.0F, metal.eta, metal.k);
  CHECK(seen.r == Approx(color.r).epsilon(1e-4));
  CHECK(seen.g == Approx(color.g).epsilon(1e-4));
  CHECK(seen.b == Approx(color.b).epsilon(1e-4));
}

TEST_CASE("metals: the least and the most that a metal of a color reflects are a thousandth off", "[bsdf][metals]") {
  const auto reflected = [](const Rgb& color) {
    const Metal metal = glint::metal_of_color(color);
    return double{glint::fresnel_conductor(1.0F, metal.eta, metal.k).r};
  };
  CHECK(reflected(Rgb{0}) == Approx(0.001).epsilon(1e-3));
  CHECK(reflected(Rgb{1}) == Approx(0.999).margin(1e-4));
}

}  // namespace test_bsdf_metals

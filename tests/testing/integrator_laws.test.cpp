// SPDX-License-Identifier: MIT
#include <glint/testing/integrator_laws.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/integrator/ambient_occlusion.hpp>
#include <glint/integrator/path.hpp>

namespace test_testing_integrator_laws {

namespace {

using glint::Path;
using glint::Ray;
using glint::Rgb;

const std::vector<Ray<float>> rays{{.direction = {0.3F, 0.5F, -0.8F}}, {.direction = {-0.2F, -1, 0.1F}}};
const Path by_chance{.strategy = glint::LightStrategy::RandomWalk};

/// A path tracer with a slip.
struct Broken {
  float gain = 1;
  float first = 1;
  mutable int calls = 0;

  template <glint::SceneLike S, glint::Sampler R>
  [[nodiscard]] Rgb radiance(const S& scene, const Ray<float>& ray, R& sampler) const {
    return Path{}.radiance(scene, ray, sampler) * (calls++ == 0 ? first : gain);
  }
};

}  // namespace

TEST_CASE("integrator laws: hold for paths and for ambient occlusion", "[testing][integrator_laws]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  CHECK(glint::testing::violations_of_integrator_laws(Path{}, scene, rays, 1).empty());
  CHECK(glint::testing::violations_of_integrator_laws(glint::AmbientOcclusion{}, scene, rays, 1).empty());
}

TEST_CASE("integrator laws: find state, infinity and negative light", "[testing][integrator_laws]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const auto broken = [&](const Broken& integrator) {
    const auto violations = glint::testing::violations_of_integrator_laws(integrator, scene, rays, 1);
    REQUIRE_FALSE(violations.empty());
    return violations.front().substr(0, violations.front().find(':'));
  };
  CHECK(broken({.gain = 2}) == "equal numbers give equal radiance");
  CHECK(broken({.gain = -1, .first = -1}) == "radiance is not negative");
  constexpr float infinity = std::numeric_limits<float>::infinity();
  CHECK(broken({.gain = infinity, .first = infinity}) == "radiance is finite");
}

TEST_CASE("integrator laws: paths agree with paths by chance, and not where light is gained",
          "[testing][integrator_laws]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  CHECK(glint::testing::violations_of_agreement(Path{}, by_chance, scene, rays, 4000, 1).empty());
  CHECK(glint::testing::violations_of_agreement(Broken{.gain = 1.05F}, by_chance, scene, rays, 4000, 1).size() == 1);
}

}  // namespace test_testing_integrator_laws

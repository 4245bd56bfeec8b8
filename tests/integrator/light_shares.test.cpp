// SPDX-License-Identifier: MIT
#include <glint/integrator/light_shares.hpp>  // first, so the header proves it stands alone

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/integrator/ambient_occlusion.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/integrator/path.hpp>
#include <glint/sampler/independent.hpp>

namespace test_integrator_light_shares {

using glint::Direct;
using glint::light_shares;
using glint::LightShares;
using glint::LightStrategy;
using glint::Path;
using glint::Rgb;

namespace {

const glint::Ray<float> somewhere{.direction = {0.3F, 0.5F, -0.8F}};

/// Paths of one, two, three and seven segments.
struct Tells {
  Rgb radiance(const auto& /*scene*/, const glint::Ray<float>& /*ray*/, auto& /*sampler*/) const { return 15; }
  void for_each_light(const auto& /*scene*/, const glint::Ray<float>& /*ray*/, auto& /*sampler*/,
                      const auto& bring) const {
    bring(Rgb{1}, 1);
    bring(Rgb{2}, 2);
    bring(Rgb{4}, 3);
    bring(Rgb{8}, 7);
  }
};

/// The shares of one sample.
template <typename I>
LightShares shares_of(const I& integrator, const auto& scene, int sample) {
  auto sampler = glint::Independent{.seed = 3}.stream({1, 2}, sample);
  return light_shares(integrator, scene, somewhere, sampler);
}

}  // namespace

TEST_CASE("light shares: light is dealt out by the segments of its path", "[integrator][light_shares]") {
  CHECK(shares_of(Tells{}, Furnace{}.scene(0), 0) ==
        LightShares{.emission = Rgb{1}, .direct = Rgb{2}, .indirect = Rgb{12}, .sum = Rgb{15}});
}

TEST_CASE("light shares: in a furnace they are the terms of the geometric series", "[integrator][light_shares]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  // A random walk meets a wall at each of four segments, with weights of exactly ½: 1, then ½, then ¼ + ⅛.
  const Path walk{.max_depth = 4, .roulette_below = 0, .strategy = LightStrategy::RandomWalk};
  const LightShares expected{.emission = Rgb{1}, .direct = Rgb{0.5F}, .indirect = Rgb{0.375F}, .sum = Rgb{1.875F}};
  for (int sample = 0; sample < 20; ++sample) CHECK(shares_of(walk, scene, sample) == expected);
  // Direct light has no more than two segments where nothing is specular.
  const Direct direct{.strategy = LightStrategy::RandomWalk};
  CHECK(shares_of(direct, scene, 0) == LightShares{.emission = Rgb{1}, .direct = Rgb{0.5F}, .sum = Rgb{1.5F}});
}

TEST_CASE("light shares: the sum has the bits of the radiance, and the shares add up to it",
          "[integrator][light_shares]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.7F);
  const auto check = [&](const auto& integrator) {
    for (int sample = 0; sample < 2000; ++sample) {
      auto sampler = glint::Independent{.seed = 3}.stream({1, 2}, sample);
      const Rgb radiance = integrator.radiance(scene, somewhere, sampler);
      const LightShares shares = shares_of(integrator, scene, sample);
      REQUIRE(shares.sum == radiance);
      const Rgb together = shares.emission + shares.direct + shares.indirect;
      // Each of the three is rounded to float, and so are the two sums: five times half a last place of the radiance.
      REQUIRE(std::abs(together.g - radiance.g) <= 5 * 0.6e-7F * radiance.g);
    }
  };
  check(Path{});
  check(Path{.strategy = LightStrategy::NextEvent});
  check(Path{.clamp = {.direct = 0.3F, .indirect = 0.1F}});
  check(Direct{});
}

TEST_CASE("light shares: clamped light is shared out as it is left", "[integrator][light_shares]") {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const Path walk{.max_depth = 3,
                  .roulette_below = 0,
                  .strategy = LightStrategy::RandomWalk,
                  .clamp = {.direct = 0.25F, .indirect = 0.125F}};
  CHECK(shares_of(walk, scene, 0) ==
        LightShares{.emission = Rgb{1}, .direct = Rgb{0.25F}, .indirect = Rgb{0.125F}, .sum = Rgb{1.375F}});
}

TEST_CASE("light shares: not every integrator tells them", "[integrator][light_shares]") {
  using Scene = decltype(Furnace{}.scene(0));
  static_assert(glint::TermwiseIntegratorFor<Path, Scene, glint::IndependentSampler>);
  static_assert(glint::TermwiseIntegratorFor<Direct, Scene, glint::IndependentSampler>);
  static_assert(!glint::TermwiseIntegratorFor<glint::AmbientOcclusion, Scene, glint::IndependentSampler>);
}

}  // namespace test_integrator_light_shares

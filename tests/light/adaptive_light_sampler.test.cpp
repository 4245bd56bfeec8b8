// SPDX-License-Identifier: MIT
#include <glint/light/adaptive_light_sampler.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <span>
#include <vector>

#include <support/catch.hpp>

#include <glint/light/point.hpp>

namespace test_light_adaptive_light_sampler {

using glint::AdaptiveLightSampler;
using glint::PointLight;
using glint::Rgb;

namespace {

/// A row of lights, one as strong as the next.
std::vector<PointLight> row(std::size_t count) {
  std::vector<PointLight> lights;
  for (std::size_t i = 0; i < count; ++i) lights.push_back({{static_cast<float>(i), 0, 0}, Rgb{1}});
  return lights;
}

}  // namespace

TEST_CASE("adaptive light sampler: among few lights their power decides", "[light][adaptive_light_sampler]") {
  const auto lights = row(AdaptiveLightSampler::many - 1);
  const AdaptiveLightSampler sampler(std::span<const PointLight>(lights), {});
  const glint::PowerLightSampler by_power(std::span<const PointLight>(lights), {});
  CHECK(sampler.probability({0, 0, 1}, {0, 0, 1}, 3) == by_power.probability(3));
  CHECK(sampler.choose({0, 0, 1}, {0, 0, 1}, 0.7F) == by_power.choose(0.7F));
}

TEST_CASE("adaptive light sampler: among many it matters where they are", "[light][adaptive_light_sampler]") {
  const auto lights = row(AdaptiveLightSampler::many);
  const AdaptiveLightSampler sampler(std::span<const PointLight>(lights), {});
  CHECK(sampler.probability({0, 0, 1}, {0, 0, 1}, 0) > 5 * sampler.probability({0, 0, 1}, {0, 0, 1}, 15));
  CHECK(sampler.choose({0, 0, 1}, {0, 0, 1}, 0.7F).has_value());
}

TEST_CASE("adaptive light sampler: without lights nothing is chosen", "[light][adaptive_light_sampler]") {
  CHECK_FALSE(AdaptiveLightSampler{}.choose({}, {}, 0.5F));
}

}  // namespace test_light_adaptive_light_sampler

// SPDX-License-Identifier: MIT
#include <glint/light/light_sampler.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include <support/catch.hpp>

#include <glint/light/directional.hpp>
#include <glint/light/point.hpp>

namespace test_light_light_sampler {

using glint::PointLight;
using glint::PowerLightSampler;
using glint::Rgb;

TEST_CASE("light sampler: lights are chosen in proportion to their power", "[light][light_sampler]") {
  const std::array lights{PointLight{.intensity = Rgb{1}}, PointLight{.intensity = Rgb{0}},
                          PointLight{.intensity = Rgb{3}}};
  const PowerLightSampler sampler(std::span<const PointLight>(lights), {});
  CHECK(sampler.probability(0) == Approx(0.25F));
  CHECK(sampler.probability(1) == 0);
  CHECK(sampler.probability(2) == Approx(0.75F));
  std::array<int, 3> counts{};
  constexpr int n = 4096;
  for (int i = 0; i < n; ++i) {
    const auto chosen = sampler.choose((static_cast<float>(i) + 0.5F) / n);
    CHECK(chosen.probability == sampler.probability(chosen.index));
    ++counts[chosen.index];
  }
  CHECK(counts[0] == Approx(n / 4).margin(2));
  CHECK(counts[1] == 0);
}

TEST_CASE("light sampler: uniformly, each light is chosen by the share of one", "[light][light_sampler]") {
  const std::array<PointLight, 5> lights{};
  const glint::UniformLightSampler sampler(std::span<const PointLight>(lights), {});
  for (std::uint32_t i = 0; i < 5; ++i) {
    const auto chosen = sampler.choose({}, {}, (static_cast<float>(i) + 0.5F) / 5);
    CHECK(chosen == glint::ChosenLight{i, 0.2F});
    CHECK(sampler.probability({}, {}, i) == 0.2F);
  }
  CHECK_FALSE(glint::UniformLightSampler{}.choose({}, {}, 0.5F));
}

TEST_CASE("light sampler: by power, it does not matter from where lights are seen", "[light][light_sampler]") {
  const std::array lights{PointLight{.intensity = Rgb{1}}, PointLight{.intensity = Rgb{3}}};
  const PowerLightSampler sampler(std::span<const PointLight>(lights), {});
  CHECK(sampler.choose({1, 2, 3}, {0, 0, 1}, 0.9F) == sampler.choose(0.9F));
  CHECK(sampler.probability({1, 2, 3}, {0, 0, 1}, 1) == sampler.probability(1));
  CHECK_FALSE(PowerLightSampler{}.choose({}, {}, 0.5F));
}

TEST_CASE("light sampler: where nothing shines it is empty", "[light][light_sampler]") {
  CHECK(PowerLightSampler{}.empty());
  const std::array lights{PointLight{.intensity = Rgb{0}}};
  CHECK(PowerLightSampler(std::span<const PointLight>(lights), {}).empty());
}

TEST_CASE("light sampler: a sun over an unbounded scene can still be chosen", "[light][light_sampler]") {
  const std::array suns{glint::DirectionalLight{}};
  const glint::Aabb<float> unbounded{glint::Vec3<float>(std::numeric_limits<float>::lowest()),
                                     glint::Vec3<float>(std::numeric_limits<float>::max())};
  const PowerLightSampler sampler(std::span<const glint::DirectionalLight>(suns), unbounded);
  CHECK(sampler.probability(0) == 1);
}

}  // namespace test_light_light_sampler

// SPDX-License-Identifier: MIT
#include <glint/testing/light_sampler_laws.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/light/adaptive_light_sampler.hpp>
#include <glint/light/light_bvh.hpp>
#include <glint/light/point.hpp>

namespace test_testing_light_sampler_laws {

namespace {

using glint::ChosenLight;
using glint::PointLight;
using glint::Rgb;
using glint::Vec3;

const std::vector<PointLight> lights{
    {{0, 2, 0}, Rgb{1}}, {{1, 1, 1}, Rgb{5}}, {{-1, 0, 1}, Rgb{0.5F}}, {{0, -1, 2}, Rgb{2}}, {{2, 0, 0}, Rgb{0}}};
const glint::Aabb<float> scene{{-2, -2, -2}, {2, 2, 2}};

template <typename S>
std::vector<std::string> violations(const S& sampler) {
  return glint::testing::violations_of_light_sampler_laws(sampler, std::span(lights), scene, 1);
}

enum class Slip { None, Never, Misstates, Uneven };

/// A uniform choice with a slip.
struct Broken {
  Slip slip = Slip::None;

  [[nodiscard]] std::optional<ChosenLight> choose(const Vec3<float>& from, const Vec3<float>& normal, float u) const {
    const auto index = static_cast<std::uint32_t>((slip == Slip::Uneven ? u * u : u) * 5);
    if (slip == Slip::Never && index == 1) return std::nullopt;
    return ChosenLight{index, slip == Slip::Misstates ? 0.25F : probability(from, normal, index)};
  }
  [[nodiscard]] float probability(const Vec3<float>& /*from*/, const Vec3<float>& /*normal*/,
                                  std::uint32_t light) const {
    return slip == Slip::Never && light == 1 ? 0 : 0.2F;
  }
};

std::string first(Slip slip) {
  const auto broken = violations(Broken{slip});
  return broken.empty() ? std::string() : broken.front().substr(0, broken.front().find(':'));
}

}  // namespace

TEST_CASE("light sampler laws: hold for the library's ways to choose", "[testing][light_sampler_laws]") {
  const std::span<const PointLight> all(lights);
  CHECK(violations(glint::UniformLightSampler(all, scene)) == std::vector<std::string>{});
  CHECK(violations(glint::PowerLightSampler(all, scene)) == std::vector<std::string>{});
  CHECK(violations(glint::LightBvh(all, scene)) == std::vector<std::string>{});
  CHECK(violations(glint::AdaptiveLightSampler(all, scene)) == std::vector<std::string>{});
}

TEST_CASE("light sampler laws: find each slip, and name it", "[testing][light_sampler_laws]") {
  CHECK(first(Slip::None).empty());
  CHECK(first(Slip::Never) == "a light that reaches a point can be chosen");
  CHECK(first(Slip::Misstates) == "a choice states its probability");
  CHECK(first(Slip::Uneven) == "a light is chosen as often as its probability says");
}

}  // namespace test_testing_light_sampler_laws

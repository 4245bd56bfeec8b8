// SPDX-License-Identifier: MIT
#include <glint/testing/light_laws.hpp>  // first, so the header proves it stands alone

#include <optional>
#include <string>

#include <support/catch.hpp>

#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>

namespace test_testing_light_laws {

using glint::LightSample;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;

namespace {

/// A point light whose samples a functor spoils.
template <typename Spoil>
struct Broken {
  Spoil spoil;
  glint::PointLight light{.position = {0, 0, 2}};

  std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& u) const {
    auto result = light.sample(from, u);
    if (result) spoil(*result);
    return result;
  }
  Rgb power(const glint::Aabb<float>& scene) const { return light.power(scene); }
};
template <typename Spoil>
Broken(Spoil) -> Broken<Spoil>;

/// A sky that is sampled by a density it does not state.
struct LyingSky {
  glint::ConstantEnvironment sky{};

  std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& u) const {
    auto result = sky.sample(from, u);
    result->pdf *= 2;
    return result;
  }
  Rgb background(const Vec3<float>& direction) const { return sky.background(direction); }
  static float pdf(const Vec3<float>& direction) { return glint::ConstantEnvironment::pdf(direction); }
  Rgb power(const glint::Aabb<float>& scene) const { return sky.power(scene); }
};

std::string first_violation(const auto& light) {
  const auto violations = glint::testing::violations_of_light_laws(light, {0, 0, 0}, 1);
  return violations.empty() ? "" : violations.front();
}

bool names(const std::string& sentence, const char* words) {
  return sentence.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("light laws: an honest light breaks none", "[testing][light_laws]") {
  CHECK(first_violation(glint::PointLight{.position = {0, 0, 2}}).empty());
  CHECK(first_violation(glint::ConstantEnvironment{}).empty());
}

TEST_CASE("light laws: each kind of fault is found and named", "[testing][light_laws]") {
  CHECK(names(first_violation(Broken{[](LightSample& s) { s.wi *= 2; }}), "unit length"));
  CHECK(names(first_violation(Broken{[](LightSample& s) { s.pdf = 0; }}), "density"));
  CHECK(names(first_violation(Broken{[](LightSample& s) { s.radiance.g = -1; }}), "negative"));
  CHECK(names(first_violation(Broken{[](LightSample& s) { s.target.x += 1; }}), "target"));
  CHECK(names(first_violation(LyingSky{}), "density that sample states"));
}

}  // namespace test_testing_light_laws

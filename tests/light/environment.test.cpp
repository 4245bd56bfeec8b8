// SPDX-License-Identifier: MIT
#include <glint/light/environment.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <memory>
#include <optional>

#include <support/catch.hpp>

#include <glint/math/affine.hpp>
#include <glint/testing/chi_square.hpp>
#include <glint/testing/light_laws.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/image_texture.hpp>

namespace test_light_environment {

using glint::ConstantEnvironment;
using glint::ConstantTexture;
using glint::EnvironmentLight;
using glint::Image;
using glint::ImageTexture;
using glint::Mat3;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;

namespace {

/// A dim sky with a sun of four pixels.
ImageTexture sky() {
  Image image({32, 16}, Rgb{0.1F, 0.2F, 0.3F});
  for (const int x : {20, 21}) {
    for (const int y : {4, 5}) image(x, y) = Rgb{50, 40, 30};
  }
  return {.image = std::make_shared<const Image>(image), .wrap_t = glint::Wrap::Clamp};
}

/// Directions with z as the pole of the test's grid where the panorama has y.
Vec3<float> to_test(const Vec3<float>& w) {
  return {-w.z, w.x, w.y};
}
Vec3<float> from_test(const Vec3<float>& w) {
  return {w.y, w.z, -w.x};
}

}  // namespace

TEST_CASE("constant environment: a surface receives π L", "[light][environment]") {
  const ConstantEnvironment light{Rgb{2}};
  glint::Random random{1};
  double sum = 0;
  constexpr int n = 100'000;
  for (int i = 0; i < n; ++i) {
    const auto sample = light.sample({0, 0, 0}, random.uniform_vec2());
    REQUIRE(sample);
    sum += static_cast<double>(std::max(0.0F, sample->wi.z) * sample->radiance.r / sample->pdf) / n;
  }
  CHECK(sum == Approx(2 * glint::pi<double>).epsilon(0.02));
  CHECK(glint::testing::violations_of_light_laws(light, {0, 0, 0}, 3).empty());
}

TEST_CASE("environment light: looks like its texture turned into the scene", "[light][environment]") {
  const auto turn = glint::Affine<float>::rotate({0, 1, 0}, glint::radians(90.0F));  // −z, at u = 0, goes to −x
  Image image({4, 1}, Rgb{0});
  image(0, 0) = Rgb{1};
  const ImageTexture texture{.image = std::make_shared<const Image>(image),
                             .interpolation = glint::Interpolation::Nearest};
  const EnvironmentLight light(texture, {4, 1}, Rgb{3}, turn.linear);
  // u in [0, 1/4) is lit: from −z to +x before the turn, from −x to −z after it.
  CHECK(light.background({-0.7F, 0, -0.7F}) == Rgb{3});
  CHECK(light.background({0.7F, 0, -0.7F}) == Rgb{0});
  CHECK(light.background({0.7F, 0, 0.7F}) == Rgb{0});
}

TEST_CASE("environment light: samples follow their density", "[light][environment]") {
  const EnvironmentLight light(sky(), {32, 16});
  const auto result = glint::testing::chi_square_sphere(
      [&](float, const Vec2<float>& uv) -> std::optional<Vec3<float>> {
        const auto sample = light.sample({0, 0, 0}, uv);
        if (!sample) return std::nullopt;
        return to_test(sample->wi);
      },
      [&](const Vec3<float>& w) { return light.pdf(from_test(w)); }, {.significance = 1e-4});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("environment light: the density of a stretched one still is a density", "[light][environment]") {
  const EnvironmentLight light(sky(), {32, 16}, 1, Mat3<float>(2, 0, 0, 0, 0.5F, 0, 0.3F, 0, 1));
  glint::Random random{2};
  double sum = 0;
  constexpr int n = 200'000;
  for (int i = 0; i < n; ++i) {
    const float z = 1 - 2 * random.uniform<float>();
    const float phi = 2 * glint::pi<float> * random.uniform<float>();
    const float r = std::sqrt(std::max(0.0F, 1 - z * z));
    sum += static_cast<double>(light.pdf({r * std::cos(phi), r * std::sin(phi), z})) * 4 * glint::pi<double> / n;
  }
  CHECK(sum == Approx(1).epsilon(0.06));  // the sun makes the standard error about 1.5 %
}

TEST_CASE("environment light: no direction that shines is out of reach", "[light][environment]") {
  const EnvironmentLight light(sky(), {32, 16});
  glint::Random random{4};
  for (int i = 0; i < 2000; ++i) {
    const Vec3<float> w = glint::equirectangular_to_direction(random.uniform_vec2());
    if (light.background(w).r > 0) CHECK(light.pdf(w) > 0);
  }
}

TEST_CASE("environment light: of one color it has the power of a constant one", "[light][environment]") {
  const glint::Aabb<float> scene{{-1, -1, -1}, {1, 1, 1}};
  const EnvironmentLight light(ConstantTexture{Rgb{2}}, {256, 128});
  CHECK(light.power(scene).r == Approx(ConstantEnvironment{Rgb{2}}.power(scene).r).epsilon(1e-3));
}

TEST_CASE("environment light: compensated, it leaves out what is below the mean", "[light][environment]") {
  const EnvironmentLight light(sky(), {32, 16}, 1, Mat3<float>(1), glint::EnvironmentChoice::Compensated);
  const EnvironmentLight plain(sky(), {32, 16});
  const Vec3<float> sun = glint::equirectangular_to_direction(Vec2<float>{21.0F / 32, 5.0F / 16});
  CHECK(light.pdf(sun) > plain.pdf(sun));
  CHECK(light.pdf({0, -0.6F, 0.8F}) == 0);
  CHECK(light.background(sun) == plain.background(sun));
  const glint::Aabb<float> scene{{-1, -1, -1}, {1, 1, 1}};
  CHECK(light.power(scene) == plain.power(scene));
  const auto result = glint::testing::chi_square_sphere(
      [&](float, const Vec2<float>& uv) {
        return std::optional(to_test(light.sample({0, 0, 0}, uv)->wi));
      },
      [&](const Vec3<float>& w) { return light.pdf(from_test(w)); }, {.significance = 1e-4});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("environment light: compensated, it is right together with another strategy, and less noisy",
          "[light][environment]") {
  // Irradiance with z up, from one sample of the light and one cosine-weighted direction, by the balance heuristic.
  const auto estimate = [](const auto& light, double& variance) {
    glint::Random random{8};
    double sum = 0;
    double squares = 0;
    constexpr int n = 100'000;
    for (int i = 0; i < n; ++i) {
      double value = 0;
      const auto add = [&](const Vec3<float>& w) {
        const float by_cosine = glint::cosine_hemisphere_pdf(w.z);
        if (!(by_cosine > 0)) return;
        value += static_cast<double>(luminance(light.background(w)) * w.z / (by_cosine + light.pdf(w)));
      };
      const auto sample = light.sample({0, 0, 0}, random.uniform_vec2());
      if (sample) add(sample->wi);
      add(glint::cosine_hemisphere(random.uniform_vec2()));
      sum += value;
      squares += value * value;
    }
    variance = (squares / n - sum / n * (sum / n)) / n;
    return sum / n;
  };
  double plain = 0;
  double compensated = 0;
  // The sun, around u = 21/32, v = 5/16, stands on the side of +z.
  const double expected = estimate(EnvironmentLight(sky(), {32, 16}), plain);
  const double found = estimate(
      EnvironmentLight(sky(), {32, 16}, 1, Mat3<float>(1), glint::EnvironmentChoice::Compensated), compensated);
  CHECK(std::abs(found - expected) < 5 * std::sqrt(plain + compensated));
  CHECK(compensated < plain);
}

TEST_CASE("environment light: an even one has nothing to compensate", "[light][environment]") {
  const EnvironmentLight light(ConstantTexture{Rgb{2}}, {16, 8}, 1, Mat3<float>(1),
                               glint::EnvironmentChoice::Compensated);
  CHECK(glint::testing::violations_of_light_laws(light, {0, 0, 0}, 1).empty());
}

TEST_CASE("environment light: obeys the laws of Light", "[light][environment][laws]") {
  const auto seed = static_cast<std::uint64_t>(GENERATE(range(0, 4)));
  CAPTURE(seed);
  const EnvironmentLight light(sky(), {32, 16}, Rgb{0.5F});
  const auto violations = glint::testing::violations_of_light_laws(light, {0, 0, 0}, seed);
  for (const auto& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

}  // namespace test_light_environment

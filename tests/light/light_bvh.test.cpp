// SPDX-License-Identifier: MIT
#include <glint/light/light_bvh.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <support/catch.hpp>

#include <glint/core/one_of.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/light/area.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/light/spot.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>
#include <glint/testing/chi_square.hpp>

namespace test_light_light_bvh {

using glint::AreaLight;
using glint::LightBvh;
using glint::PointLight;
using glint::Quad;
using glint::Rgb;
using glint::SpotLight;
using glint::Vec3;

namespace {

using AnyLight = glint::OneOf<PointLight, SpotLight, AreaLight<Quad<float>>, glint::DirectionalLight>;

Vec3<float> random_point(glint::Random& random) {
  const float x = random.uniform<float>();
  const float y = random.uniform<float>();
  return Vec3<float>{x, y, random.uniform<float>()} * 10.0F;
}

/// Tiny squares with random normals in a cube of ten: as good as points with a cosine.
std::vector<AreaLight<Quad<float>>> small_emitters(int count) {
  glint::Random random{3};
  std::vector<AreaLight<Quad<float>>> lights;
  for (int i = 0; i < count; ++i) {
    const Vec3<float> origin = random_point(random);
    const auto frame = glint::Frame<float>::around(glint::uniform_sphere(random.uniform_vec2()));
    lights.push_back({{origin, frame.x * 1e-3F, frame.y * 1e-3F}, Rgb{1e6F * random.uniform<float>()}});
  }
  return lights;
}

std::vector<AnyLight> mixed_lights() {
  glint::Random random{5};
  std::vector<AnyLight> lights;
  for (const auto& quad : small_emitters(20)) lights.emplace_back(quad);
  for (int i = 0; i < 20; ++i) {
    const Vec3<float> position = random_point(random);
    const Vec3<float> direction = glint::uniform_sphere(random.uniform_vec2());
    lights.emplace_back(PointLight{position, Rgb{random.uniform<float>()}});
    lights.emplace_back(SpotLight{position, direction, Rgb{random.uniform<float>()}});
  }
  lights.emplace_back(glint::DirectionalLight{});
  lights.emplace_back(PointLight{{1, 1, 1}, Rgb{0}});
  lights.emplace_back(glint::DirectionalLight{{1, 0, 0}});
  return lights;
}

/// What a light brings to a facing surface: the irradiance of a small one.
template <typename L>
double contribution(const L& light, const Vec3<float>& from, const Vec3<float>& normal) {
  const auto sample = light.sample(from, glint::Vec2<float>(0.5F));
  if (!sample) return 0;
  return static_cast<double>(luminance(sample->radiance) * std::max(0.0F, glm::dot(sample->wi, normal)) / sample->pdf);
}

/// The exact mean and variance of an estimate that chooses one light.
struct Moments {
  double mean = 0;
  double variance = 0;
};
template <typename S, typename L>
Moments moments(const S& sampler, const std::vector<L>& lights, const Vec3<float>& from, const Vec3<float>& normal) {
  double sum = 0;
  double squares = 0;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const double value = contribution(lights[i], from, normal);
    if (value > 0) squares += value * value / static_cast<double>(sampler.probability(from, normal, i));
    sum += value;
  }
  return {sum, squares - sum * sum};
}

}  // namespace

TEST_CASE("light bvh: the probabilities of all lights, and of none, add up to one from anywhere",
          "[light][light_bvh]") {
  const auto lights = mixed_lights();
  const LightBvh sampler(std::span<const AnyLight>(lights), {});
  glint::Random random{1};
  for (int i = 0; i < 50; ++i) {
    const Vec3<float> from = random_point(random) * 2.0F - 5.0F;
    const Vec3<float> normal = i % 4 == 0 ? Vec3<float>(0) : glint::uniform_sphere(random.uniform_vec2());
    constexpr int n = 4096;
    double sum = 0;
    for (int k = 0; k < n; ++k) {
      if (!sampler.choose(from, normal, (static_cast<float>(k) + 0.5F) / n)) sum += 1.0 / n;
    }
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      sum += static_cast<double>(sampler.probability(from, normal, k));
    }
    CHECK(sum == Approx(1).margin(20.0 / n));  // each gap in u that chooses none is known to a step at either end
  }
}

TEST_CASE("light bvh: the probabilities of lights that shine everywhere add up to one", "[light][light_bvh]") {
  glint::Random random{1};
  std::vector<PointLight> lights;
  for (int i = 0; i < 300; ++i) lights.push_back({random_point(random), Rgb{random.uniform<float>()}});
  const LightBvh sampler(std::span<const PointLight>(lights), {});
  for (int i = 0; i < 50; ++i) {
    const Vec3<float> from = random_point(random) * 2.0F - 5.0F;
    const Vec3<float> normal = glint::uniform_sphere(random.uniform_vec2());
    double sum = 0;
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      sum += static_cast<double>(sampler.probability(from, normal, k));
    }
    CHECK(sum == Approx(1).epsilon(1e-5));
  }
}

TEST_CASE("light bvh: lights are chosen as often as their probability says", "[light][light_bvh]") {
  const auto lights = mixed_lights();
  const LightBvh sampler(std::span<const AnyLight>(lights), {});
  const Vec3<float> from{4, 5, 3};
  const Vec3<float> normal{0.6F, 0, 0.8F};
  constexpr int n = 50'000;
  std::vector<double> observed(lights.size() + 1, 0.0);  // the last: none
  std::vector<double> expected;
  glint::Random random{2};
  int wrong = 0;
  for (int i = 0; i < n; ++i) {
    const auto chosen = sampler.choose(from, normal, random.uniform<float>());
    observed[chosen ? chosen->index : lights.size()] += 1;
    if (!chosen) continue;
    const float stated = sampler.probability(from, normal, chosen->index);
    if (!(std::abs(chosen->probability - stated) <= 1e-4F * stated)) ++wrong;
  }
  CHECK(wrong == 0);
  double none = n;
  for (std::uint32_t k = 0; k < lights.size(); ++k) {
    expected.push_back(n * static_cast<double>(sampler.probability(from, normal, k)));
    none -= expected.back();
  }
  expected.push_back(std::max(0.0, none));
  const auto result = glint::testing::chi_square(observed, expected, {.significance = 1e-4});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("light bvh: no light that reaches a surface is out of reach", "[light][light_bvh]") {
  const auto lights = mixed_lights();
  const LightBvh sampler(std::span<const AnyLight>(lights), {});
  glint::Random random{9};
  for (int i = 0; i < 500; ++i) {
    const Vec3<float> from = random_point(random);
    const Vec3<float> normal = glint::uniform_sphere(random.uniform_vec2());
    for (std::uint32_t k = 0; k < lights.size(); ++k) {
      if (contribution(lights[k], from, normal) > 0) CHECK(sampler.probability(from, normal, k) > 0);
    }
  }
}

TEST_CASE("light bvh: among thousands of lights it has a tenth of the variance of a uniform choice",
          "[light][light_bvh]") {
  // Both variances are exact sums over all lights. That of the uniform choice is about n times the mean of the squares,
  // which the few lights nearby rule: those within a tenth of the cube, a thousandth of all, give a tenth of the light.
  // The tree gives them such a share. What it cannot know of a group, which of its lights face the surface (one in four
  // here), leaves a few times the squared mean; for the uniform choice it is a hundred times, so a tenth leaves room.
  const auto lights = small_emitters(4000);
  const std::span<const AreaLight<Quad<float>>> all(lights);
  const LightBvh tree(all, {});
  const glint::UniformLightSampler uniform(all, {});
  glint::Random random{4};
  double by_tree = 0;
  double by_uniform = 0;
  for (int i = 0; i < 20; ++i) {
    const Vec3<float> from = random_point(random);
    const Vec3<float> normal = glint::uniform_sphere(random.uniform_vec2());
    const Moments of_tree = moments(tree, lights, from, normal);
    const Moments of_uniform = moments(uniform, lights, from, normal);
    CHECK(of_tree.mean == of_uniform.mean);
    by_tree += of_tree.variance / (of_tree.mean * of_tree.mean);
    by_uniform += of_uniform.variance / (of_uniform.mean * of_uniform.mean);
  }
  INFO("relative variances: " << by_tree / 20 << " and " << by_uniform / 20);
  CHECK(by_tree < 0.1 * by_uniform);
}

TEST_CASE("light bvh: one light a sample is the sum over all lights, on average", "[light][light_bvh]") {
  const auto lights = small_emitters(4000);
  const LightBvh tree(std::span<const AreaLight<Quad<float>>>(lights), {});
  const Vec3<float> from{4, 5, 3};
  const Vec3<float> normal{0.6F, 0, 0.8F};
  const Moments exact = moments(tree, lights, from, normal);
  glint::Random random{6};
  double sum = 0;
  constexpr int n = 50'000;
  for (int i = 0; i < n; ++i) {
    const auto chosen = tree.choose(from, normal, random.uniform<float>());
    if (chosen) sum += contribution(lights[chosen->index], from, normal) / static_cast<double>(chosen->probability);
  }
  CHECK(std::abs(sum / n - exact.mean) < 5 * std::sqrt(exact.variance / n));
}

TEST_CASE("light bvh: lights in one place are told apart", "[light][light_bvh]") {
  const std::vector<PointLight> lights(100);
  const LightBvh sampler(std::span<const PointLight>(lights), {});
  for (std::uint32_t k = 0; k < 100; ++k) {
    CHECK(sampler.probability({3, 0, 0}, {-1, 0, 0}, k) == Approx(0.01F));
    CHECK(sampler.choose({3, 0, 0}, {-1, 0, 0}, (static_cast<float>(k) + 0.5F) / 100).has_value());
  }
}

TEST_CASE("light bvh: a row of lights whose distances double makes no tree too deep", "[light][light_bvh]") {
  std::vector<PointLight> lights;
  for (int i = 0; i < 120; ++i) lights.push_back({{std::ldexp(1.0F, i - 60), 0, 0}, Rgb{1}});
  const LightBvh sampler(std::span<const PointLight>(lights), {});
  double sum = 0;
  for (std::uint32_t k = 0; k < lights.size(); ++k) {
    sum += static_cast<double>(sampler.probability({1, 1, 0}, {}, k));
  }
  CHECK(sum == Approx(1).epsilon(1e-5));
}

TEST_CASE("light bvh: lights at infinity are chosen apart, each as often as all the others", "[light][light_bvh]") {
  const auto lights = mixed_lights();
  const LightBvh sampler(std::span<const AnyLight>(lights), {});
  const auto last = static_cast<std::uint32_t>(lights.size() - 1);
  CHECK(sampler.probability({}, {}, last) == Approx(1.0F / 3));
  CHECK(sampler.probability({}, {}, last - 2) == Approx(1.0F / 3));
  CHECK(sampler.probability({}, {}, last - 1) == 0);  // gives no light
  const std::vector<glint::ConstantEnvironment> skies(1);
  const LightBvh only_sky(std::span<const glint::ConstantEnvironment>(skies), {});
  CHECK(only_sky.choose({}, {}, 0.99F) == glint::ChosenLight{0, 1});
}

TEST_CASE("light bvh: where nothing shines, nothing is chosen", "[light][light_bvh]") {
  CHECK_FALSE(LightBvh{}.choose({}, {}, 0.5F));
  const std::vector<PointLight> dark{{.intensity = Rgb{0}}};
  CHECK_FALSE(LightBvh(std::span<const PointLight>(dark), {}).choose({}, {}, 0.5F));
}

}  // namespace test_light_light_bvh

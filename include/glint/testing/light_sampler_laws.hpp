// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/concepts.hpp>
#include <glint/light/light_sampler.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>
#include <glint/testing/chi_square.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {
namespace detail {

[[nodiscard]] inline std::string seen_from(const Vec3<float>& from, const Vec3<float>& normal) {
  const auto text = [](const Vec3<float>& v) {
    return '(' + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ')';
  };
  return "from " + text(from) + " with the normal " + text(normal);
}

/// Whether some point of the light is seen to shine.
template <Light L>
[[nodiscard]] bool reaches(const L& light, const Vec3<float>& from, Random& random) {
  for (int i = 0; i < 8; ++i) {
    const auto sample = light.sample(from, random.uniform_vec2());
    if (sample && luminance(sample->radiance) > 0) return true;
  }
  return false;
}

/// How often each light is chosen, and last how often none is.
template <LightSampler S>
[[nodiscard]] std::vector<double> choices(const S& sampler, std::size_t lights, const Vec3<float>& from,
                                          const Vec3<float>& normal, Random& random, Violations& violations) {
  constexpr int count = 4000;
  std::vector<double> observed(lights + 1);
  for (int i = 0; i < count; ++i) {
    const auto chosen = sampler.choose(from, normal, random.uniform<float>());
    const std::size_t index = chosen ? chosen->index : lights;
    violations.expect(index <= lights, "a chosen light is one of those there are", double(index), double(lights));
    if (index > lights) continue;
    ++observed[index];
    if (!chosen) continue;
    const float stated = sampler.probability(from, normal, chosen->index);
    violations.expect(std::abs(chosen->probability - stated) <= 1e-3F * stated, "a choice states its probability",
                      double(chosen->probability), double(stated));
  }
  return observed;
}

}  // namespace detail

/// What a way to choose lights breaks of the laws of LightSampler, from some points in and about a scene and for all
/// normals, a sentence each; nothing where it keeps them all.
///
/// - Each light is chosen as often as its probability says (χ²), which each choice states; none where they all are
/// zero.
/// - A light that reaches a surface has a probability above zero.
///
/// Requires: the lights and the box that the sampler was made of; few lights, so that each is chosen now and then.
template <LightSampler S, Light L>
[[nodiscard]] std::vector<std::string> violations_of_light_sampler_laws(const S& sampler, std::span<const L> lights,
                                                                        const Aabb<float>& scene, std::uint64_t seed) {
  constexpr int places = 12;
  Violations violations;
  Random random{seed};
  for (int place = 0; place < places; ++place) {
    const Vec3<float> from = detail::random_point(scene, random);
    const Vec3<float> normal = place % 3 == 0 ? Vec3<float>(0.0F) : uniform_sphere(random.uniform_vec2());
    const auto observed = detail::choices(sampler, lights.size(), from, normal, random, violations);
    double total = 0;
    double sum = 0;
    for (const double count : observed) total += count;
    std::vector<double> expected;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      const auto probability = static_cast<double>(sampler.probability(from, normal, i));
      expected.push_back(probability * total);
      sum += probability;
      violations.expect(probability > 0 || !detail::reaches(lights[i], from, random) || normal == Vec3<float>(0.0F),
                        "a light that reaches a point can be chosen", detail::seen_from(from, normal));
    }
    violations.expect(sum < 1 + 1e-3, "probabilities add up to one, or less", sum, 1);
    expected.push_back(std::max(0.0, 1 - sum) * total);
    const auto result = chi_square(observed, expected, {.significance = 1e-4, .tests = places});
    violations.expect(result.passed, "a light is chosen as often as its probability says",
                      detail::seen_from(from, normal) + ": " + result.message);
  }
  return violations.take();
}

}  // namespace glint::testing

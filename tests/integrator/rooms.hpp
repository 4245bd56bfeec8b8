// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/light/area.hpp>
#include <glint/light/lights.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/integrator_laws.hpp>

using glint::testing::Estimate;

/// The radiance along a ray, from many samples.
template <typename I, typename S>
Estimate estimate(const I& integrator, const S& scene, const glint::Ray<float>& ray, int samples) {
  return glint::testing::estimate_radiance(integrator, scene, ray, samples, 11);
}

/// The inside of the cube [−1, 1]³: six walls that face inward.
inline std::vector<glint::Quad<float>> room_walls() {
  return {{{-1, -1, -1}, {2, 0, 0}, {0, 2, 0}}, {{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
          {{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}}, {{1, -1, -1}, {0, 0, 2}, {0, 2, 0}},
          {{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}}, {{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}}};
}

/// A room all of whose walls shine with radiance one: the oldest closed form of light transport, for what arrives
/// anywhere after n segments is 1 + ρ + … + ρⁿ⁻¹.
struct Furnace {
  using Light = glint::AreaLight<glint::Quad<float>>;

  std::vector<glint::Quad<float>> walls = room_walls();

  [[nodiscard]] auto scene(float reflectance) const {
    glint::Lights<Light> lights;
    for (std::uint32_t i = 0; i < walls.size(); ++i) {
      lights.all.push_back({walls[i], glint::Rgb{1}});
      lights.of_primitive.push_back(i);
    }
    return glint::Scene{glint::Bvh{glint::Elements{walls}}, glint::Lambertian{glint::Rgb{reflectance}}, lights};
  }
};

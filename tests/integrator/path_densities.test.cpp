// SPDX-License-Identifier: MIT
#include <glint/integrator/path_densities.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include <support/catch.hpp>

namespace test_integrator_path_densities {

using glint::PathDensities;

namespace {

constexpr std::size_t count = 6;  ///< vertices, a light at 0, a camera at 5

/// Made-up densities of every step of one path, both ways.
struct Steps {
  std::array<double, count - 1> squared_distance{};
  std::array<double, count - 1> cos_near{};   ///< of segment i at vertex i
  std::array<double, count - 1> cos_far{};    ///< and at vertex i + 1
  std::array<double, count> toward_camera{};  ///< by solid angle, at a vertex
  std::array<double, count> toward_light{};
  double light_area = 0;  ///< of the light's point, when light is emitted
  double direct = 0;      ///< when a surface looks for it

  /// By area, with which a path from the light, or from the camera, steps on to vertex i.
  [[nodiscard]] double from_light(std::size_t i) const {
    return toward_camera[i - 1] * cos_far[i - 1] / squared_distance[i - 1];
  }
  [[nodiscard]] double from_camera(std::size_t i) const {
    return toward_light[i + 1] * cos_near[i] / squared_distance[i];
  }

  /// The density of the way with s vertices from the light.
  [[nodiscard]] double way(std::size_t s) const {
    double product = s == 1 ? direct : (s > 1 ? light_area : 1);
    for (std::size_t i = 1; i < s; ++i) product *= from_light(i);
    for (std::size_t i = s; i + 1 < count; ++i) product *= from_camera(i);
    return product;
  }

  /// The power heuristic's weight, from all products.
  [[nodiscard]] double weight(std::size_t s) const {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += way(i) * way(i);
    return way(s) * way(s) / sum;
  }
};

Steps some_steps() {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> some(0.3, 2);
  Steps steps;
  for (auto* values : {&steps.squared_distance, &steps.cos_near, &steps.cos_far}) {
    for (double& value : *values) value = some(random);
  }
  for (double& value : steps.toward_camera) value = static_cast<double>(static_cast<float>(some(random)));
  for (double& value : steps.toward_light) value = static_cast<double>(static_cast<float>(some(random)));
  steps.light_area = some(random);
  steps.direct = some(random);
  return steps;
}

glint::BsdfSample sampled(double pdf) {
  return {.pdf = static_cast<float>(pdf)};
}

/// What the path from the light knows at vertex `end` ≥ 1.
PathDensities light_path(const Steps& p, std::size_t end) {
  const double emitted = p.light_area * p.from_light(1);
  PathDensities d{PathDensities::squared(p.direct / emitted),
                  PathDensities::squared(p.cos_near[0] / p.squared_distance[0] / emitted)};
  for (std::size_t i = 1; i < end; ++i) {
    d.leave(sampled(p.toward_camera[i]), p.cos_near[i], p.toward_light[i]);
    d.arrive(p.squared_distance[i], p.cos_far[i]);
  }
  return d;
}

/// What the path from the camera knows at vertex `end` ≤ 4.
PathDensities camera_path(const Steps& p, std::size_t end) {
  PathDensities d{1 / PathDensities::squared(p.from_camera(count - 2)), 0};
  for (std::size_t i = count - 2; i > end; --i) {
    d.leave(sampled(p.toward_light[i]), p.cos_far[i - 1], p.toward_camera[i]);
    d.arrive(p.squared_distance[i - 1], p.cos_near[i - 1]);
  }
  return d;
}

}  // namespace

TEST_CASE("path densities: weights are those of all the products of densities", "[integrator][path_densities]") {
  const Steps p = some_steps();
  // Two ends that meet, s = 2, 3, 4: vertices s − 1 and s.
  for (std::size_t s = 2; s + 1 < count; ++s) {
    const double others = light_path(p, s - 1).others(p.from_camera(s - 1), p.toward_light[s - 1]) +
                          camera_path(p, s).others(p.from_light(s), p.toward_camera[s]);
    CAPTURE(s);
    CHECK(1 / (1 + others) == Approx(p.weight(s)).epsilon(1e-9));
  }
  // Looking for the light, s = 1.
  const double next_event = PathDensities::squared(p.from_camera(0) / p.direct) +
                            camera_path(p, 1).others(p.light_area * p.from_light(1) / p.direct, p.toward_camera[1]);
  CHECK(1 / (1 + next_event) == Approx(p.weight(1)).epsilon(1e-9));
  // Showing itself to the camera, s = 5.
  const double shown = light_path(p, count - 2).others(p.from_camera(count - 2), p.toward_light[count - 2]);
  CHECK(1 / (1 + shown) == Approx(p.weight(count - 1)).epsilon(1e-9));
  // Meeting it by chance, s = 0.
  const double emitted = p.light_area * p.toward_camera[0];
  CHECK(1 / (1 + camera_path(p, 0).others_at_end(p.direct, emitted)) == Approx(p.weight(0)).epsilon(1e-9));
}

TEST_CASE("path densities: a specular vertex is no place to connect", "[integrator][path_densities]") {
  PathDensities d{3, 5};
  d.leave({.pdf = 0.5F, .lobe = glint::Lobe::Specular}, 0.5, 0);
  CHECK(d.last == 0);
  CHECK(d.earlier == 1.25);  // 5 · ½²
}

}  // namespace test_integrator_path_densities

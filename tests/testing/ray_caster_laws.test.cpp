// SPDX-License-Identifier: MIT
#include <glint/testing/ray_caster_laws.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <optional>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

#include <support/catch.hpp>

namespace test_testing_ray_caster_laws {

namespace {

using glint::Hit;
using glint::Ray;
using Spheres = glint::Elements<glint::Sphere<float>>;

const std::vector<glint::Sphere<float>> shapes{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{0, 2, 1}, 0.5F}};

enum class Fault { None, LosesFarHits, AlwaysOccluded, IgnoresTheEnd, WrongPrimitive };

/// Brute force with one thing wrong.
struct Faulty {
  using Scalar = float;
  using Index = std::uint32_t;
  glint::BruteForce<Spheres> good{Spheres{shapes}};
  Fault fault = Fault::None;

  [[nodiscard]] glint::Aabb<float> bounds() const { return good.bounds(); }
  [[nodiscard]] std::optional<Hit<float>> closest(Ray<float> ray) const {
    if (fault == Fault::IgnoresTheEnd) ray.t_max = glint::infinity<float>;
    auto hit = good.closest(ray);
    if (hit && fault == Fault::LosesFarHits && hit->t > 1) return std::nullopt;
    if (hit && fault == Fault::WrongPrimitive) hit->t *= 1.01F;
    return hit;
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const {
    return fault == Fault::AlwaysOccluded || closest(ray).has_value();
  }
};
static_assert(glint::RayCaster<Faulty>);

}  // namespace

TEST_CASE("ray caster laws: each catches who breaks it", "[testing]") {
  const glint::BruteForce oracle{Spheres{shapes}};
  const auto broken = [&](Fault fault) {
    return glint::testing::violations_of_ray_caster_laws(Faulty{.fault = fault}, oracle, 1).size();
  };
  CHECK(broken(Fault::None) == 0);
  CHECK(broken(Fault::LosesFarHits) > 0);
  CHECK(broken(Fault::AlwaysOccluded) > 0);
  CHECK(broken(Fault::IgnoresTheEnd) > 0);
  CHECK(broken(Fault::WrongPrimitive) > 0);
}

TEST_CASE("ray caster laws: answers agree within rounding, and no further", "[testing]") {
  const Ray<float> ray{.origin = {1, 0, 0}};
  const std::optional<Hit<float>> none;
  const auto at = [](float t) { return std::optional(Hit<float>{.t = t, .primitive = 1}); };
  CHECK(glint::testing::agree(ray, none, none));
  CHECK_FALSE(glint::testing::agree(ray, none, at(1)));
  CHECK_FALSE(glint::testing::agree(ray, at(1), none));
  CHECK(glint::testing::agree(ray, at(1), at(1.000001F)));
  CHECK_FALSE(glint::testing::agree(ray, at(1), at(1.0001F)));
}

}  // namespace test_testing_ray_caster_laws

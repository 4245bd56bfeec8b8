// SPDX-License-Identifier: MIT
#include <glint/integrator/concepts.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/intersection_test.hpp>
#include <glint/integrator/path.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/scene.hpp>

namespace test_integrator_concepts {

namespace {

using TestScene = glint::Scene<glint::BruteForce<glint::Elements<glint::Sphere<float>>>>;
using TestSampler = decltype(glint::Independent{}.stream({}, 0));

/// A user's integrator: distance as gray.
struct Distance {
  glint::Rgb radiance(const auto& scene, const glint::Ray<float>& ray, glint::Sampler auto& /*sampler*/) const {
    const auto at = scene.interact(ray);
    return at ? glm::length(at->surface.position - ray.origin) : 0.0F;
  }
};

}  // namespace

TEST_CASE("integrator: the library's and a user's model one concept", "[integrator][concepts]") {
  STATIC_REQUIRE(glint::IntegratorFor<glint::Path, TestScene, TestSampler>);
  STATIC_REQUIRE(glint::IntegratorFor<glint::IntersectionTest, TestScene, TestSampler>);
  STATIC_REQUIRE(glint::IntegratorFor<Distance, TestScene, TestSampler>);
  STATIC_REQUIRE_FALSE(glint::IntegratorFor<int, TestScene, TestSampler>);
}

}  // namespace test_integrator_concepts

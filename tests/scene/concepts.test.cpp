// SPDX-License-Identifier: MIT
#include <glint/scene/concepts.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/scene/scene.hpp>

namespace test_scene_concepts {

using Geometry = glint::BruteForce<glint::Elements<glint::Sphere<float>>>;

TEST_CASE("scene concept: a scene is one, its geometry alone is not", "[scene][concepts]") {
  STATIC_REQUIRE(glint::SceneLike<glint::Scene<Geometry>>);
  STATIC_REQUIRE_FALSE(glint::SceneLike<Geometry>);
}

}  // namespace test_scene_concepts

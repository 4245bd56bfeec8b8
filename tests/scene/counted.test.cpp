// SPDX-License-Identifier: MIT
#include <glint/scene/counted.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/point.hpp>
#include <glint/scene/scene.hpp>

namespace test_scene_counted {

TEST_CASE("counted scene: answers as the scene does, and counts the rays", "[scene][counted]") {
  const std::vector<glint::Sphere<float>> spheres{{.center = {0, 0, -5}}};
  const glint::Scene scene{glint::BruteForce{glint::Elements{spheres}}, glint::Lambertian{}, glint::PointLight{}};
  std::uint64_t rays = 0;
  const glint::Counted counted{scene, rays};
  static_assert(glint::SceneLike<decltype(counted)>);
  CHECK(counted.interact({})->surface == scene.interact({})->surface);
  CHECK(counted.occluded({}));
  CHECK_FALSE(counted.occluded({.direction = {0, 0, 1}}));
  CHECK(rays == 3);
  CHECK(counted.closest({}) == scene.closest({}));
  CHECK(rays == 4);
  CHECK(&counted.materials() == &scene.materials());
  CHECK(counted.background({0, 0, 1}) == scene.background({0, 0, 1}));
  CHECK(counted.light_count() == 1);
  CHECK(counted.light(0) == scene.light(0));
  CHECK(&counted.light_sampler() == &scene.light_sampler());
  CHECK(counted.infinite_lights().empty());
  CHECK(rays == 4);
}

}  // namespace test_scene_counted

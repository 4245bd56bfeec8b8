// SPDX-License-Identifier: MIT
#include <glint/bvh/build/quality.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_quality {

using glint::Boxes;
using glint::Quality;
using glint::QualityBuilder;

TEMPLATE_TEST_CASE("quality: every one obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float,
                   double) {
  for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Best})
    glint::testing::check_builder(TestType{}, QualityBuilder{quality});
}

TEST_CASE("quality: among large triangles the best costs rays less; the fast costs little more anywhere",
          "[bvh][build]") {
  const auto cost = [](const auto& mesh, Quality quality) {
    return glint::build(view(mesh), quality).statistics().sah_cost;
  };
  const auto blob = glint::testing::scanned_blob<float>(3000, 1);
  auto mixed = glint::testing::triangle_soup<float>(3000, 1);
  glint::Random random(2);
  for (std::size_t i = 0; i < 90; ++i)  // some thirty that go through all of it
    mixed.positions[i * 100] = random.uniform_vec3<float>() * 2.0F - 1.0F;
  CHECK(cost(mixed, Quality::Best) < 0.95 * cost(mixed, Quality::Balanced));
  CHECK(cost(mixed, Quality::Fast) < 1.25 * cost(mixed, Quality::Balanced));
  CHECK(cost(blob, Quality::Fast) < 1.25 * cost(blob, Quality::Balanced));
}

TEST_CASE("quality: balanced is what a Bvh is built with unless told otherwise", "[bvh][build]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 2);
  CHECK(glint::build(view(soup)).statistics() == glint::Bvh(view(soup)).statistics());
}

TEST_CASE("quality: rays meet what brute force meets, in every quality and layout", "[bvh][build][laws]") {
  const auto soup = glint::testing::triangle_soup<float>(300, 3);
  const std::vector<glint::Sphere<float>> spheres{{{0, 0, 0}, 1}, {{0, 3, 0}, 2}, {{4, 0, 1}, 1}};
  const auto check = [](const auto& bvh) {
    for (const std::string& broken :
         glint::testing::violations_of_ray_caster_laws(bvh, glint::BruteForce(bvh.set()), 1)) {
      FAIL_CHECK(broken);
    }
  };
  for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Best}) {
    check(glint::build(view(soup), quality));
    check(glint::build(view(soup), quality, glint::Serial{}, glint::binary));
    check(glint::build(glint::Elements{spheres}, quality));
  }
}

}  // namespace test_bvh_build_quality

// SPDX-License-Identifier: MIT
#include <glint/bvh/build/quality.hpp>  // first, so the header proves it stands alone

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
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

using glint::Boxes;
using glint::Quality;
using glint::QualityBuilder;

TEMPLATE_TEST_CASE("quality: every one obeys the laws of builders whatever the boxes", "[bvh][build][laws]", float,
                   double) {
  for (const Quality quality : {Quality::Fast, Quality::Balanced, Quality::Best})
    glint::testing::check_builder(TestType{}, QualityBuilder{quality});
}

TEST_CASE("quality: the best costs rays less than the others, and the fast not much more", "[bvh][build]") {
  const auto blob = glint::testing::scanned_blob<float>(3000, 1);
  const auto cost = [&](Quality quality) { return glint::build(view(blob), quality).statistics().sah_cost; };
  CHECK(cost(Quality::Best) < cost(Quality::Balanced));
  CHECK(cost(Quality::Best) < cost(Quality::Fast));
  CHECK(cost(Quality::Fast) < 1.25 * cost(Quality::Balanced));
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

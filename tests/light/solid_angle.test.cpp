// SPDX-License-Identifier: MIT
#include <glint/light/solid_angle.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/geometry/disk.hpp>

namespace test_light_solid_angle {

TEST_CASE("solid angle: a density by area counts for distance² / cosine as much", "[light][solid_angle]") {
  // Two along z away, seen under 60°: distance² = 4 / cos² 60° = 16, cosine 1/2.
  const glint::Surface at{.position = {0, 0, 2}, .normal = {0, 0, -1}};
  CHECK(glint::seen_area_pdf(0.25F, {std::sqrt(12.0F), 0, 0}, at) == Approx(0.25F * 16 / 0.5F));
  CHECK(glint::seen_area_pdf(0.25F, {0, 0, 3}, at) == 0);  // from behind
}

TEST_CASE("solid angle: points chosen by area are only those in sight", "[light][solid_angle]") {
  const glint::Disk<float> disk{.normal = {0, 0, 1}, .radius = 2};
  const auto sample = glint::sample_seen_by_area(disk, {0, 0, 3}, {0, 0.5F});  // the center
  REQUIRE(sample);
  CHECK(sample->pdf == Approx(9 / (4 * glint::pi<float>)));
  CHECK_FALSE(glint::sample_seen_by_area(disk, {0, 0, -3}, {0.5F, 0.5F}));
}

}  // namespace test_light_solid_angle

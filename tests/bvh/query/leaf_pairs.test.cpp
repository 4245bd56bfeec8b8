// SPDX-License-Identifier: MIT
#include <glint/bvh/query/leaf_pairs.hpp>  // first, so the header proves it stands alone

#include <glint/geometry/sphere.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_leaf_pairs {

TEST_CASE("leaf pairs: primitives that know nothing of each other are tested with each other's boxes",
          "[bvh][query][pairs]") {
  const glint::Triangle<float> triangle{{3, 0, 0}, {0, 3, 0}, {0, 0, 3}};  // x + y + z = 3
  const auto meet = [&](const glint::Sphere<float>& sphere) {
    return glint::detail::primitives_overlap(
        triangle, sphere, [&] { return bounds(triangle); }, [&] { return bounds(sphere); });
  };
  CHECK(meet({{1, 1, 1}, 0.1F}));
  CHECK_FALSE(meet({{0.5F, 0.5F, 0.5F}, 0.1F}));  // its box is in the triangle's, and ends at 0.6 + 0.6 + 0.6
  CHECK(meet({{0.91F, 0.91F, 0.91F}, 0.1F}));  // its box reaches the plane, 3.03 > 3; the sphere does not, 2.73 + 0.17
}

}  // namespace test_bvh_query_leaf_pairs

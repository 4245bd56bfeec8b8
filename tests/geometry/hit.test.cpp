// SPDX-License-Identifier: MIT
#include <glint/geometry/hit.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_geometry_hit {

TEMPLATE_TEST_CASE("hit: the default names no primitive, and none within it", "[geometry][hit]", float, double) {
  const glint::Hit<TestType> hit;
  CHECK(hit.primitive == glint::none<std::uint32_t>);
  CHECK(hit.inner == glint::none<std::uint32_t>);
  CHECK(glint::Hit<TestType, std::uint64_t>{}.primitive == glint::none<std::uint64_t>);
  CHECK(hit == glint::Hit<TestType>{});
}

}  // namespace test_geometry_hit

// SPDX-License-Identifier: MIT
#include <glint/bvh/concepts.hpp>  // first, so the header proves it stands alone

#include <cstdint>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>

namespace test_bvh_concepts {

TEST_CASE("concepts: the library's builders, layouts and queries model them", "[bvh]") {
  using Set = glint::Boxes<double>;
  STATIC_REQUIRE(glint::BuilderFor<glint::Median, Set>);
  STATIC_REQUIRE(glint::BuilderFor<glint::BinnedSah, Set>);
  STATIC_REQUIRE(glint::BuilderFor<glint::SweepSah, Set>);
  STATIC_REQUIRE_FALSE(glint::BuilderFor<int, Set>);
  STATIC_REQUIRE(glint::Layout<glint::BinaryNodes<double, std::uint64_t>>);
  STATIC_REQUIRE(glint::Layout<glint::WideNodes<float, std::uint32_t, 4>>);
  STATIC_REQUIRE_FALSE(glint::Layout<glint::Tree<float>>);
  STATIC_REQUIRE(glint::QueryFor<glint::RayQuery<float, 8, glint::RayOrder::Any>, float, 8>);
  STATIC_REQUIRE_FALSE(glint::QueryFor<glint::RayQuery<float, 8, glint::RayOrder::Any>, float, 4>);
}

TEST_CASE("concepts: a link with slots is a leaf", "[bvh]") {
  CHECK_FALSE(glint::Link<std::uint32_t>{3, 0}.is_leaf());
  const glint::Link<std::uint32_t> leaf{3, 2};
  CHECK(leaf.is_leaf());
  CHECK(leaf.slots().first == 3);
  CHECK(leaf.slots().count == 2);
}

}  // namespace test_bvh_concepts

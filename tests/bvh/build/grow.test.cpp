// SPDX-License-Identifier: MIT
#include <glint/bvh/build/grow.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/pass/validate.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_build_grow {

namespace {

using glint::detail::Part;
using glint::detail::Reference;
using glint::detail::References;

/// Takes off one reference as long as it may: what no bound on the depth would survive.
struct Peeler {
  std::span<Reference<float>> references;
  std::size_t max_leaf_size = 1;

  template <typename Executor>
  std::optional<std::pair<Part<float>, Part<float>>> split(const Part<float>& part, std::size_t capacity,
                                                           const Executor& /*executor*/) const {
    if (part.count <= max_leaf_size) return std::nullopt;
    if (part.count - 1 > capacity) return glint::detail::halve<float>(references.subspan(part.first, part.count), part);
    const auto run = references.subspan(part.first, part.count);
    return std::pair{glint::detail::measured<float>(run.first(1), part.first, false),
                     glint::detail::measured<float>(run.subspan(1), part.first + 1, false)};
  }
  template <typename I>
  void write(const Part<float>& part, I* order) const {
    for (const auto& r : references.subspan(part.first, part.count)) *order++ = I(r.index());
  }
};

}  // namespace

TEST_CASE("grow: the worst splitter reaches the depth limit and does not pass it", "[bvh][build]") {
  const auto boxes = glint::testing::random_boxes<float>(1000, 4);
  for (const int depth : {3, 10, 12, 64}) {
    const auto tree = glint::detail::grow_tree(
        glint::Boxes{boxes}, glint::Serial{}, [](References<float>& r, const auto& /*root*/) { return Peeler{r}; }, 1,
        depth);
    CAPTURE(depth);
    CHECK(tree.depth == depth);
    CHECK(violations(tree, glint::Boxes{boxes}).empty());
  }
}

TEST_CASE("grow: nodes are numbered depth first", "[bvh][build]") {
  const auto boxes = glint::testing::random_boxes<float>(4, 5);
  const auto tree = glint::detail::grow_tree(
      glint::Boxes{boxes}, glint::Serial{}, [](References<float>& r, const auto& /*root*/) { return Peeler{r}; }, 1,
      64);
  REQUIRE(tree.nodes.size() == 7);
  CHECK(tree.nodes[0].first == 1);
  CHECK(tree.nodes[1].is_leaf());
  CHECK(tree.nodes[2].first == 3);
  CHECK(tree.nodes[4].first == 5);
}

}  // namespace test_bvh_build_grow

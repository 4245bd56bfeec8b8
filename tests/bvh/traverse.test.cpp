// SPDX-License-Identifier: MIT
#include <glint/bvh/traverse.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/ray_box.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>
#include <support/shared.hpp>

namespace test_bvh_traverse {

namespace {

using glint::Aabb;
using glint::Boxes;
using glint::Tree;
using glint::Walk;

/// Which boxes touch a box, by the key of how far their lower x is: a query that has nothing to do with rays.
struct Overlap {
  static constexpr bool ordered = true;
  Aabb<float> box;
  float last = glint::infinity<float>;

  template <int N>
  [[nodiscard]] glint::Entered<float, N> enter(const glint::BoxPack<float, N>& boxes) const {
    glint::Entered<float, N> entered{0, boxes.planes[0]};
    for (int i = 0; i < N; ++i) {
      const auto plane = [&](std::size_t p) { return boxes.planes[p][i]; };
      const Aabb<float> child{{plane(0), plane(1), plane(2)}, {plane(3), plane(4), plane(5)}};
      if (!is_empty(overlap(box, child)) && plane(0) <= last) entered.mask |= 1U << i;
    }
    return entered;
  }
  [[nodiscard]] float limit() const { return last; }
};

/// The boxes a ray meets, by walking the tree and testing what is in the leaves.
template <typename Nodes>
std::vector<unsigned> boxes_met(const std::vector<Aabb<float>>& boxes, const Tree<float>& tree,
                                const glint::Ray<float>& ray) {
  std::vector<unsigned> met;
  const auto world = tree.nodes.empty() ? Aabb<float>{} : tree.nodes.front().bounds;
  const glint::RayQuery<float, Nodes::width, glint::RayOrder::Any> query(ray, glint::RayReach<float>::of(world));
  glint::traverse(Nodes(tree), query, [&](const auto& slots) {
    for (std::size_t slot = slots.first; slot < slots.first + slots.count; ++slot)
      if (intersect(ray, boxes[tree.order[slot]])) met.push_back(tree.order[slot]);
    return Walk::Continue;
  });
  std::sort(met.begin(), met.end());
  return met;
}

template <typename Nodes>
void check_overlap() {
  const auto boxes = glint::testing::random_boxes<float>(300, 6);
  const auto tree = glint::BinnedSah{.block_size = 1, .max_leaf_size = 2}.build(Boxes{boxes});
  for (const auto& asked : glint::testing::random_boxes<float>(50, 7)) {
    std::vector<unsigned> expected;
    for (unsigned i = 0; i < boxes.size(); ++i)
      if (!is_empty(overlap(boxes[i], asked))) expected.push_back(i);
    std::vector<unsigned> found;
    glint::traverse(Nodes(tree), Overlap{asked}, [&](const auto& slots) {
      for (std::size_t slot = slots.first; slot < slots.first + slots.count; ++slot)
        if (!is_empty(overlap(boxes[tree.order[slot]], asked))) found.push_back(tree.order[slot]);
      return Walk::Continue;
    });
    std::sort(found.begin(), found.end());
    CHECK(found == expected);
  }
}

}  // namespace

TEST_CASE("traverse: a query of one's own finds what it asks for", "[bvh][traverse]") {
  check_overlap<glint::BinaryNodes<float, std::uint32_t>>();
  check_overlap<glint::WideNodes<float, std::uint32_t, 4>>();
  check_overlap<glint::WideNodes<float, std::uint32_t, 8>>();
}

TEST_CASE("traverse: leaves come in the order of their keys, and none beyond the limit", "[bvh][traverse]") {
  std::vector<Aabb<float>> row;
  for (int i = 0; i < 64; ++i) row.push_back({{float(2 * i), 0, 0}, {float(2 * i + 1), 1, 1}});
  const auto tree = glint::Median{.max_leaf_size = 1}.build(Boxes{row});
  Overlap query{.box = {{0, 0, 0}, {1000, 1, 1}}};
  std::vector<unsigned> visited;
  const auto visit = [&](const auto& slots) {
    visited.push_back(tree.order[slots.first]);
    if (visited.size() == 10) query.last = 40;  // the answer improved: what lies beyond no longer matters
    return Walk::Continue;
  };
  CHECK(glint::traverse(glint::WideNodes<float, std::uint32_t, 8>(tree), query, visit) == Walk::Continue);
  REQUIRE(visited.size() == 21);  // 0, 2, … 40
  for (unsigned i = 0; i < visited.size(); ++i) CHECK(visited[i] == i);
}

TEST_CASE("traverse: a visit can end the walk", "[bvh][traverse]") {
  const auto boxes = glint::testing::random_boxes<float>(100, 8);
  const auto tree = glint::Median{}.build(Boxes{boxes});
  int visits = 0;
  const auto visit = [&](const auto&) { return ++visits == 3 ? Walk::Stop : Walk::Continue; };
  CHECK(glint::traverse(glint::BinaryNodes<float, std::uint32_t>(tree), Overlap{{{0, 0, 0}, {1, 1, 1}}}, visit) ==
        Walk::Stop);
  CHECK(visits == 3);
}

TEST_CASE("traverse: in the deepest tree, a sibling waiting on every step fits the stack", "[bvh][traverse]") {
  constexpr unsigned steps = Tree<float>::max_depth;
  const std::vector<Aabb<float>> boxes(steps + 1, {{-1, -1, -1}, {1, 1, 1}});
  std::vector<unsigned> all;
  for (unsigned i = 0; i <= steps; ++i) all.push_back(i);
  for (const unsigned inner_side : {0U, 1U}) {  // one of them is where walks go first, so that leaves pile up
    Tree<float> tree{.nodes = {{boxes[0], 1, 0}}, .order = all, .depth = int(steps)};
    for (unsigned i = 0; i < steps; ++i) {
      const glint::BinaryNode<float> leaf{boxes[0], i, 1};
      const glint::BinaryNode<float> inner{boxes[0], 2 * i + 3, 0};
      const glint::BinaryNode<float> last{boxes[0], steps, 1};
      const auto& deeper = i + 1 < steps ? inner : last;
      tree.nodes.push_back(inner_side == 0 ? deeper : leaf);
      tree.nodes.push_back(inner_side == 0 ? leaf : deeper);
    }
    REQUIRE(violations(tree, Boxes{boxes}).empty());
    const glint::Ray<float> ray{.origin = {0, 0, 3}};
    CHECK(boxes_met<glint::BinaryNodes<float, std::uint32_t>>(boxes, tree, ray) == all);
    CHECK(boxes_met<glint::WideNodes<float, std::uint32_t, 2>>(boxes, tree, ray) == all);
    CHECK(boxes_met<glint::WideNodes<float, std::uint32_t, 8>>(boxes, tree, ray) == all);
  }
}

TEST_CASE("traverse: agrees with reference cases", "[bvh][traverse][vectors]") {
  const auto text = glint::testing::shared_file("vectors/bvh.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  const auto vec = [](const nlohmann::json& v) { return glint::Vec3<float>{v[0], v[1], v[2]}; };
  REQUIRE_FALSE(vectors["cases"].empty());
  for (const auto& test : vectors["cases"]) {
    CAPTURE(test["name"].get<std::string>());
    std::vector<Aabb<float>> boxes;
    for (int copy = 0; copy < test.value("repeat", 1); ++copy) {
      for (const auto& box : test["boxes"]) {
        const glint::Vec3<float> half(box["size"].get<float>() / 2);
        boxes.push_back({vec(box["center"]) - half, vec(box["center"]) + half});
      }
    }
    const auto check = [&](const auto& builder) {
      const auto tree = builder.build(Boxes{boxes});
      CHECK(violations(tree, Boxes{boxes}).empty());
      if (!test.contains("ray")) return;
      const glint::Ray<float> ray{.origin = vec(test["ray"]["o"]), .direction = vec(test["ray"]["d"])};
      const auto met = boxes_met<glint::WideNodes<float, std::uint32_t, 8>>(boxes, tree, ray);
      CHECK(met.empty() == !test["expect"]["hit"].get<bool>());
      if (test["expect"].contains("hit_boxes")) CHECK(met == test["expect"]["hit_boxes"].get<std::vector<unsigned>>());
    };
    check(glint::Median{});
    check(glint::BinnedSah{});
    check(glint::SweepSah{});
  }
}

}  // namespace test_bvh_traverse

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/testing/builder_laws.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

/// A leaf: its run of slots, and its box.
template <std::floating_point T>
struct LeafBox {
  std::size_t first = 0;
  std::size_t count = 0;
  Aabb<T> box{};

  [[nodiscard]] friend bool operator==(const LeafBox&, const LeafBox&) noexcept = default;
  [[nodiscard]] friend bool operator<(const LeafBox& a, const LeafBox& b) noexcept { return a.first < b.first; }
};

/// The leaves of a tree by their slots.
template <std::floating_point T, std::unsigned_integral I>
[[nodiscard]] std::vector<LeafBox<T>> leaves_of(const Tree<T, I>& tree) {
  std::vector<LeafBox<T>> leaves;
  for (const auto& node : tree.nodes)
    if (node.is_leaf()) leaves.push_back({node.first, node.count, node.bounds});
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

/// What a walk through a layout of the tree finds, by slots; missing children, which no ray can enter, are passed over.
template <Layout L>
[[nodiscard]] std::vector<LeafBox<typename L::Scalar>> leaves_of(
    const L& layout, const Tree<typename L::Scalar, typename L::Index>& tree) {
  using T = typename L::Scalar;
  std::vector<LeafBox<T>> leaves;
  if (layout.empty()) return leaves;
  if (layout.root().is_leaf()) return leaves_of(tree);
  std::vector<typename L::Index> pending{layout.root().first};
  while (!pending.empty()) {
    const auto node = pending.back();
    pending.pop_back();
    const BoxPack<T, L::width>& boxes = layout.children(node);
    const auto& links = layout.links(node);
    for (int i = 0; i < L::width; ++i) {
      std::array<T, 6> planes;
      for (std::size_t p = 0; p < 6; ++p) planes[p] = boxes.planes[p][i];
      if (!(planes[0] <= planes[3])) continue;
      const auto link = links[std::size_t(i)];
      if (link.is_leaf())
        leaves.push_back(
            {link.first, link.count, {{planes[0], planes[1], planes[2]}, {planes[3], planes[4], planes[5]}}});
      else
        pending.push_back(link.first);
    }
  }
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

/// What the layout of a choice breaks of the laws of Layout, for one tree, a sentence each; nothing where it keeps
/// them.
///
/// - A walk finds each leaf of the tree once, in a box that holds the tree's.
/// - The layout is as empty as the tree, and the same for every executor, by its leaves and bytes.
///
/// Pass trees of all kinds: of nothing, of one leaf, deep ones.
template <LayoutChoice C, std::floating_point T, std::unsigned_integral I>
[[nodiscard]] std::vector<std::string> violations_of_layout_laws(const C& choice, const Tree<T, I>& tree) {
  Violations violations;
  const auto nodes = choice.template nodes<T, I>(tree, Serial{});
  violations.expect(nodes.empty() == tree.nodes.empty(), "a layout of nothing is empty", "and no other is");
  const auto expected = leaves_of(tree);
  const auto found = leaves_of(nodes, tree);
  violations.expect(found.size() == expected.size(), "each leaf is there once", double(found.size()),
                    double(expected.size()));
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
    const std::string which = "slots from " + std::to_string(expected[i].first);
    violations.expect(found[i].first == expected[i].first && found[i].count == expected[i].count,
                      "leaves keep their slots", which);
    violations.expect(contains(found[i].box, expected[i].box), "a leaf's box holds the tree's", which);
  }
  const auto backwards = choice.template nodes<T, I>(tree, Backwards{});
  violations.expect(leaves_of(backwards, tree) == found && backwards.bytes() == nodes.bytes(),
                    "the layout is the same for every executor", "it depends on it");
  return violations.take();
}

}  // namespace glint::testing

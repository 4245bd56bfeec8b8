// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>

namespace glint::testing {

/// First slot, count and box of a leaf.
template <typename T>
using LeafBox = std::tuple<std::size_t, std::size_t, std::array<T, 6>>;

template <typename T>
[[nodiscard]] std::vector<LeafBox<T>> leaves_of(const Tree<T>& tree) {
  std::vector<LeafBox<T>> leaves;
  for (const auto& node : tree.nodes) {
    const auto& [low, high] = node.bounds;
    if (node.is_leaf()) leaves.push_back({node.first, node.count, {low.x, low.y, low.z, high.x, high.y, high.z}});
  }
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

/// What a walk through a layout finds; lanes without a child, which no ray can enter, are passed over.
template <Layout L>
[[nodiscard]] std::vector<LeafBox<typename L::Scalar>> leaves_of(const L& layout,
                                                                 const Tree<typename L::Scalar>& tree) {
  using T = typename L::Scalar;
  std::vector<LeafBox<T>> leaves;
  if (layout.empty()) return leaves;
  if (layout.root().is_leaf()) return leaves_of(tree);
  std::vector<typename L::Index> pending{layout.root().first};
  while (!pending.empty()) {
    const auto node = pending.back();
    pending.pop_back();
    const auto& boxes = layout.children(node);
    const auto& links = layout.links(node);
    for (int i = 0; i < L::width; ++i) {
      std::array<T, 6> planes;
      for (std::size_t p = 0; p < 6; ++p) planes[p] = boxes.planes[p][i];
      if (!(planes[0] <= planes[3])) continue;
      const auto link = links[std::size_t(i)];
      if (link.is_leaf())
        leaves.push_back({link.first, link.count, planes});
      else
        pending.push_back(link.first);
    }
  }
  std::sort(leaves.begin(), leaves.end());
  return leaves;
}

}  // namespace glint::testing

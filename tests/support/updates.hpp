// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glint/bvh/pass/depth_first.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>

/// What tests of passes that change trees have in common.
namespace glint::support {

/// Some of the indices below n, each once, in no order.
[[nodiscard]] inline std::vector<std::uint32_t> some_of(std::size_t n, std::size_t count, unsigned seed) {
  std::vector<std::uint32_t> all(n);
  for (std::size_t i = 0; i < n; ++i) all[i] = std::uint32_t(i);
  std::shuffle(all.begin(), all.end(), std::mt19937(seed));
  all.resize(std::min(n, count));
  return all;
}

/// All boxes but those: a box that a tree must not have is empty.
template <typename T>
[[nodiscard]] std::vector<Aabb<T>> without(std::vector<Aabb<T>> boxes, const std::vector<std::uint32_t>& indices) {
  for (const std::uint32_t i : indices) boxes[i] = {};
  return boxes;
}

/// Valid, numbered depth first.
template <typename T>
void check_tree(const Tree<T>& tree, const std::vector<Aabb<T>>& boxes) {
  for (const std::string& broken : violations(tree, Boxes<T>(boxes))) FAIL_CHECK(broken);
  CHECK(depth_first(tree) == tree);
}

/// A random ray's cost, in units of leaves' tests of blocks of four.
template <typename T>
[[nodiscard]] double cost_of(const Tree<T>& tree) {
  double cost = 0;
  for (const auto& node : tree.nodes)
    cost += double(half_area(node.bounds)) * (node.is_leaf() ? std::ceil(double(node.count) / 4) : 0.7);
  return cost;
}

}  // namespace glint::support

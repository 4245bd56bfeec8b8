// SPDX-License-Identifier: MIT
// A tree as plain arrays, for a kernel of one's own on a GPU say: written to a file, mapped into memory, and walked
// with nothing but the arrays. Each ray must meet the triangle that glint finds.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/io/mapped_tree.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

/// What a kernel declares: 32 bytes, two nodes a cache line. With count 0 the children are nodes `first` and
/// `first + 1`; else the primitives are order[first] to order[first + count - 1].
struct Node {
  float lower[3];
  float upper[3];
  std::uint32_t first;
  std::uint32_t count;
};
static_assert(sizeof(Node) == sizeof(glint::BinaryNode<float>));
static_assert(offsetof(Node, first) == offsetof(glint::BinaryNode<float>, first));

bool meets(const glint::BinaryNode<float>& node, const glint::Ray<float>& ray, float t_max) {
  const glm::vec3 a = (node.bounds.lower - ray.origin) / ray.direction;
  const glm::vec3 b = (node.bounds.upper - ray.origin) / ray.direction;
  const glm::vec3 near = glm::min(a, b);
  const glm::vec3 far = glm::max(a, b);
  const float leave = std::min({far.x, far.y, far.z}) * 1.00001F;  // a slab test rounds
  return std::max({near.x, near.y, near.z, ray.t_min}) <= std::min(leave, t_max);
}

std::uint32_t walk(const glint::TreeView<float>& tree, const auto& mesh, glint::Ray<float> ray) {
  std::uint32_t closest = glint::none<std::uint32_t>;
  std::array<std::uint32_t, 65> stack{0};  // glint's trees are at most 64 deep
  for (std::size_t size = 1; size != 0;) {
    const auto& node = tree.nodes[stack[--size]];
    if (!meets(node, ray, ray.t_max)) continue;
    for (const std::uint32_t primitive : tree.order.subspan(node.count ? node.first : 0, node.count)) {
      const auto hit = mesh.intersect(ray, primitive);
      if (!hit) continue;
      ray.t_max = hit->t;
      closest = primitive;
    }
    if (node.count != 0) continue;
    stack[size++] = node.first;
    stack[size++] = node.first + 1;
  }
  return closest;
}

}  // namespace

int main() {
  const auto buffers = glint::testing::scanned_blob<float>(20000, 1);
  const auto mesh = view(buffers);
  const glint::TreeOrigin origin{.primitives = mesh.size()};
  glint::write_tree(glint::BinnedSah{}.build(mesh), "blob.tree", origin);
  const glint::MappedTree<float> tree("blob.tree", origin);
  const glint::Bvh bvh(mesh);
  for (int i = 0; i < 10000; ++i) {
    const int row = i / 100;
    const glint::Ray<float> ray{.origin = {0.013F, 0.007F, 4},
                                .direction = {float(i % 100) / 100 - 0.503F, float(row) / 100 - 0.497F, -1}};
    const auto expected = bvh.closest(ray);
    const std::uint32_t found = walk(tree.view(), mesh, ray);
    if (found != (expected ? expected->primitive : glint::none<std::uint32_t>)) return 1;
  }
  std::printf("%zu nodes of 32 bytes, %zu slots\n", tree.view().nodes.size(), tree.view().order.size());
}

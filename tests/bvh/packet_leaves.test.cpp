// SPDX-License-Identifier: MIT
#include <glint/bvh/packet_leaves.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>
#include <support/coherent_rays.hpp>

namespace test_bvh_packet_leaves {

namespace {

using glint::Hit;
using glint::LeavesForPacket;
using glint::PacketHits;
using glint::Ray;
using glint::RayPacket;
using glint::Tree;

/// Packets visit all leaves; every second ray asks for closest hits, the others stay as they are.
template <typename Set, typename Choice>
std::size_t check_leaves(const Set& set, Choice choice) {
  using T = typename Set::Scalar;
  using I = typename Set::Index;
  Tree<T, I> tree = glint::Median{.max_leaf_size = 6}.build(set);
  const auto leaves = make_leaves(set, tree, choice, glint::Serial{});
  std::size_t hits = 0;
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    const auto rays = glint::testing::of_one_course(
        glint::testing::pencil_of_rays<T>(glint::testing::scene_box<T>(), 1 + seed % 16, T(0.1), seed));
    const RayPacket<T> packet(rays);
    if (!is_coherent(packet, T(1))) continue;
    glint::PacketQuery<T> query(packet, T(2));
    LeavesForPacket<decltype(leaves), Set> many(leaves, set, packet, query);
    PacketHits<T, I> best(packet);
    const std::uint32_t asked = packet.members & 0x5555U;
    for (const auto& node : tree.nodes) {
      if (!node.is_leaf()) continue;
      const glint::Slots<I> slots{node.first, node.count};
      const PacketHits<T, I> before = best;
      const std::uint32_t improved = many.closest(slots, asked, best);
      const std::uint32_t occluded = many.occluded(slots, asked);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const auto prepared = leaves.prepare(set, rays[i]);
        const bool asks = ((asked >> i) & 1U) != 0;
        Hit<T, I> expected = before[int(i)];
        const bool better = asks && leaves.closest(set, rays[i], prepared, slots, expected);
        CHECK(best[int(i)] == expected);
        CHECK(best.t[int(i)] == expected.t);
        CHECK((((improved >> i) & 1U) != 0) == better);
        CHECK((((occluded >> i) & 1U) != 0) == (asks && leaves.occluded(set, rays[i], prepared, slots)));
        hits += better;
      }
    }
  }
  return hits;
}

using Mesh = glint::TriangleMesh<float>;
using Blocks = decltype(make_leaves(std::declval<const Mesh&>(), std::declval<Tree<float>&>(), glint::CopiedBlocks<4>{},
                                    glint::Serial{}));
static_assert(glint::PacketLeavesOf<Blocks, Mesh>);

}  // namespace

TEMPLATE_TEST_CASE("packet leaves: blocks of triangles tell many rays what they tell each, to the last bit",
                   "[bvh][packet]", float, double) {
  const auto soup = glint::testing::triangle_soup<TestType>(150, 1);
  const auto mix = glint::testing::degenerate_mix<TestType>(150, 2);
  const auto same = glint::testing::identical_triangles<TestType>(20);
  const auto cube = glint::testing::closed_cube<TestType>();
  for (const auto* buffers : {&soup, &mix, &same, &cube}) {
    const auto watertight = view(*buffers);
    const auto fast = glint::view<glint::MoellerTrumbore>(*buffers);
    CHECK(check_leaves(watertight, glint::CopiedBlocks<4>{}) > 10);
    CHECK(check_leaves(watertight, glint::IndexedBlocks<4>{}) > 10);
    CHECK(check_leaves(watertight, glint::CopiedBlocks<8>{}) > 10);
    CHECK(check_leaves(fast, glint::CopiedBlocks<4>{}) > 10);
  }
}

TEMPLATE_TEST_CASE("packet leaves: leaves that know single rays alone are asked for one after another", "[bvh][packet]",
                   float, double) {
  std::vector<glint::Sphere<TestType>> shapes;
  for (int i = 0; i < 60; ++i) {
    const TestType at = TestType(i) / 30 - 1;
    shapes.push_back({.center = {at, -at, TestType(i % 7) / 7}, .radius = TestType(0.2)});
  }
  CHECK(check_leaves(glint::Elements{shapes}, glint::CopiedBlocks<4>{}) > 10);
}

}  // namespace test_bvh_packet_leaves

// SPDX-License-Identifier: MIT
#include <glint/bvh/packet_traverse.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/ray_box.hpp>

#include <support/catch.hpp>
#include <support/coherent_rays.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_packet_traverse {

namespace {

using glint::Aabb;
using glint::Boxes;
using glint::Link;
using glint::Ray;
using glint::RayPacket;
using glint::Slots;
using glint::Tree;

/// What each ray of a packet meets, together and alone.
template <typename Nodes>
struct Met {
  const std::vector<Aabb<float>>& boxes;
  const Tree<float>& tree;
  const Nodes nodes{tree};
  std::vector<std::vector<unsigned>> of_ray{};
  int together = 0;
  int alone = 0;

  void add(const std::vector<Ray<float>>& rays, std::size_t i, Slots<unsigned> slots) {
    for (std::size_t slot = slots.first; slot < slots.first + slots.count; ++slot)
      if (intersect(rays[i], boxes[tree.order[slot]])) of_ray[i].push_back(tree.order[slot]);
  }
  glint::Company walk(const std::vector<Ray<float>>& rays) {
    of_ray.assign(rays.size(), {});
    const RayPacket<float> packet(rays);
    const glint::PacketQuery<float> query(packet, 0.0F);
    std::vector<Link<unsigned>> fetched{nodes.empty() ? Link<unsigned>{} : nodes.root()};
    const auto is_fetched = [&](const Link<unsigned>& link) {
      return std::find(fetched.begin(), fetched.end(), link) != fetched.end();
    };
    const auto visit = [&](Slots<unsigned> slots, std::uint32_t mask) {
      CHECK(is_fetched({slots.first, slots.count}));
      ++together;
      for (std::size_t i = 0; i < rays.size(); ++i)
        if (((mask >> i) & 1U) != 0) add(rays, i, slots);
    };
    const auto visit_alone = [&](Link<unsigned> link, std::uint32_t mask) {
      CHECK(std::popcount(mask) < 8);
      CHECK(is_fetched(link));
      for (std::size_t i = 0; i < rays.size(); ++i) {
        if (((mask >> i) & 1U) == 0) continue;
        ++alone;
        follow(rays, i, link);
      }
    };
    const glint::Company company = traverse_packet(nodes, query, packet.members, visit, visit_alone,
                                                   [&](Link<unsigned> link) { fetched.push_back(link); });
    for (auto& met : of_ray) std::sort(met.begin(), met.end());
    return company;
  }
  void follow(const std::vector<Ray<float>>& rays, std::size_t i, Link<unsigned> link) {
    const std::vector<Ray<float>> only{rays[i]};
    const RayPacket<float> packet(only);
    const glint::PacketQuery<float> query(packet, 0.0F);
    // Down from the link, box by box.
    std::vector<Link<unsigned>> open{link};
    while (!open.empty()) {
      const glint::Subtree below{nodes, open.back()};
      open.pop_back();
      if (below.root().is_leaf()) {
        add(rays, i, below.root().slots());
        continue;
      }
      const glint::BoxPack<float, Nodes::width>& children = below.children(below.root().first);
      for (int child = 0; child < Nodes::width; ++child)
        if ((query.enter(children, child) & 1U) != 0)
          open.push_back(below.links(below.root().first)[std::size_t(child)]);
    }
  }
};

template <typename Nodes>
void check_layout() {
  const auto boxes = glint::testing::random_boxes<float>(300, 6);
  const auto tree = glint::BinnedSah{.block_size = 1, .max_leaf_size = 2}.build(Boxes{boxes});
  const Aabb<float> all{{0, 0, 0}, {1, 1, 1}};
  Met<Nodes> met{boxes, tree};
  int packets = 0;
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    const auto rays =
        glint::testing::of_one_course(glint::testing::pencil_of_rays<float>(all, 1 + seed % 16, 0.05F, seed));
    if (!is_coherent(RayPacket<float>(rays), 1.0F)) continue;
    ++packets;
    const glint::Company company = met.walk(rays);
    CHECK(company.visits >= 1);
    CHECK(company.rays <= company.visits * int(rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) {
      std::vector<unsigned> expected;
      for (unsigned b = 0; b < boxes.size(); ++b)
        if (intersect(rays[i], boxes[b])) expected.push_back(b);
      CHECK(met.of_ray[i] == expected);
    }
  }
  CHECK(packets > 50);
  CHECK(met.together > 100);
  CHECK(met.alone > 100);
}

}  // namespace

TEST_CASE("packet traverse: every ray meets the boxes it meets alone, in company or not", "[bvh][packet]") {
  check_layout<glint::BinaryNodes<float, std::uint32_t>>();
  check_layout<glint::WideNodes<float, std::uint32_t, 4>>();
  check_layout<glint::WideNodes<float, std::uint32_t, 8>>();
}

TEST_CASE("packet traverse: nothing is visited in a layout of nothing", "[bvh][packet]") {
  const std::vector<Aabb<float>> boxes;
  const Tree<float> tree;
  Met<glint::WideNodes<float, std::uint32_t, 8>> met{boxes, tree};
  const auto company = met.walk(std::vector<Ray<float>>(16, {.direction = {0.1F, 0.1F, -1}}));
  CHECK(company.visits == 0);
  CHECK(met.together + met.alone == 0);
}

TEST_CASE("packet traverse: company is good where many rays share their visits", "[bvh][packet]") {
  CHECK(glint::Company{.visits = 10, .rays = 120}.was_good());
  CHECK_FALSE(glint::Company{.visits = 10, .rays = 30}.was_good());
}

TEST_CASE("packet traverse: in the deepest tree, a sibling waiting on every step fits the stack", "[bvh][packet]") {
  constexpr unsigned steps = Tree<float>::max_depth;
  const std::vector<Aabb<float>> boxes(steps + 1, {{-1, -1, -1}, {1, 1, 1}});
  std::vector<unsigned> all;
  for (unsigned i = 0; i <= steps; ++i) all.push_back(i);
  const std::vector<Ray<float>> rays(16, {.origin = {0, 0, 3}, .direction = {0.01F, 0.01F, -1}});
  for (const unsigned inner_side : {0U, 1U}) {
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
    Met<glint::BinaryNodes<float, std::uint32_t>> binary{boxes, tree};
    Met<glint::WideNodes<float, std::uint32_t, 8>> wide{boxes, tree};
    binary.walk(rays);
    wide.walk(rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      CHECK(binary.of_ray[i] == all);
      CHECK(wide.of_ray[i] == all);
    }
  }
}

}  // namespace test_bvh_packet_traverse

// SPDX-License-Identifier: MIT
#include <glint/bvh/pass/refit_layout.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_pass_refit_layout {

namespace {

using glint::Vec3;

/// Where the vertices go: far enough that boxes of before are wrong.
template <typename T>
void bend(std::vector<Vec3<T>>& positions) {
  for (Vec3<T>& p : positions) p = {p.y * p.x, p.z + p.x, p.y};
}

template <typename Caster>
void check_rays(const Caster& caster, unsigned seed) {
  for (const std::string& broken :
       glint::testing::violations_of_ray_caster_laws(caster, glint::BruteForce(caster.set()), seed))
    FAIL_CHECK(broken);
}

/// By definition, from boxes that are stored as they are: each child's is the union of the leaves below.
template <typename Nodes, typename LeafBox>
glint::Aabb<float> tight_box(const Nodes& nodes, glint::Link<std::uint32_t> link, const LeafBox& leaf_box) {
  if (link.is_leaf()) return leaf_box(link.slots());
  glint::Aabb<float> all;
  const glint::BoxPack<float, Nodes::width> boxes = nodes.children(link.first);
  for (std::size_t i = 0; i != nodes.child_count(link.first); ++i) {
    const auto at = [&](std::size_t plane) { return boxes.plane(plane)[int(i)]; };
    const glint::Aabb<float> child = tight_box(nodes, nodes.links(link.first)[i], leaf_box);
    CHECK(child == glint::Aabb<float>{{at(0), at(1), at(2)}, {at(3), at(4), at(5)}});
    extend(all, child);
  }
  return all;
}

}  // namespace

TEST_CASE("refit of a Bvh: rays meet what brute force meets in the moved mesh, in every layout", "[bvh][pass][laws]") {
  auto buffers = glint::testing::scanned_blob<float>(500, 8);
  const auto original = buffers.positions;
  const auto mesh = glint::view(buffers);
  const auto check = [&](const auto& layout) {
    buffers.positions = original;
    glint::Bvh bvh(mesh, glint::BinnedSah{}, layout);
    CHECK(bvh.refit().growth == Approx(1).epsilon(0.05));  // nothing moved; quantized boxes were larger than boxes
    bend(buffers.positions);
    const glint::Refit refit = bvh.refit();
    CHECK(refit.lost == 0);
    CHECK(refit.growth > 1.05);
    check_rays(bvh, 1);
  };
  check(glint::wide<8>);
  check(glint::binary);
  check(glint::quantized<8>);
}

TEST_CASE("refit of a Bvh: sets without blocks, joined sets, and double", "[bvh][pass][laws]") {
  auto buffers = glint::testing::scanned_blob<double>(300, 3);
  std::vector<glint::Sphere<double>> spheres;
  for (int i = 0; i < 60; ++i) spheres.push_back({.center = {i % 5, i % 7, i % 3}, .radius = 0.3});
  const glint::Joined set{glint::view(buffers), glint::Elements{spheres}};
  glint::Bvh bvh(set);
  bend(buffers.positions);
  for (auto& sphere : spheres) sphere.center = {sphere.center.y, sphere.center.z * 2, sphere.center.x};
  CHECK(bvh.refit().lost == 0);
  check_rays(bvh, 2);
}

TEST_CASE("refit of a layout: each box is the union of the leaves below", "[bvh][pass]") {
  const auto before = glint::testing::random_boxes<float>(900, 4);
  const auto after = glint::testing::random_boxes<float>(900, 5);
  const auto tree = glint::BinnedSah{}.build(glint::Boxes{before});
  const auto leaf_box = [&](glint::Slots<std::uint32_t> slots) {
    glint::FittedLeaf<float> leaf;
    for (std::size_t i = 0; i != slots.count; ++i) leaf.add(after[tree.order[slots.first + i]]);
    return leaf;
  };
  glint::WideNodes<float, std::uint32_t, 8> wide(tree);
  glint::BinaryNodes<float, std::uint32_t> binary(tree);
  const auto check = [&](auto& nodes, const auto& executor) {
    const auto fitted = refit_layout(nodes, leaf_box, executor);
    CHECK(fitted.area == Approx(layout_area(nodes)));
    CHECK(fitted.bounds ==
          tight_box(nodes, nodes.root(), [&](glint::Slots<std::uint32_t> slots) { return leaf_box(slots).bounds; }));
  };
  check(wide, glint::Serial{});
  check(binary, glint::TbbExecutor{3});
  check(wide, glint::TbbExecutor{3});
}

TEST_CASE("refit of a Bvh: a triangle may lose its area, and get one again", "[bvh][pass]") {
  auto buffers = glint::testing::scanned_blob<float>(300, 6);
  const auto original = buffers.positions;
  const auto check = [&](const auto& layout) {
    buffers.positions = original;
    for (std::size_t i = 0; i < original.size() / 2; ++i) buffers.positions[i] = original[0];
    glint::Bvh bvh(glint::view(buffers), glint::BinnedSah{}, layout);
    buffers.positions = original;
    CHECK(bvh.refit().lost == 0);
    check_rays(bvh, 3);
    for (auto& p : buffers.positions) p.x = 0;
    for (std::size_t i = 0; i < original.size() / 3; ++i) buffers.positions[i] = original[0];
    bvh.refit();
    check_rays(bvh, 4);
  };
  check(glint::wide<8>);
  check(glint::quantized<4>);
}

TEST_CASE("refit of a Bvh: what lost its box is counted, and found again when it comes back", "[bvh][pass]") {
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 40; ++i) spheres.push_back({.center = {float(i), 0, 0}, .radius = 0.3F});
  const auto original = spheres;
  const auto check = [&](const auto& layout) {
    spheres = original;
    glint::Bvh bvh(glint::Elements{spheres}, glint::BinnedSah{}, layout);
    for (auto& sphere : spheres) sphere.center.x = std::numeric_limits<float>::quiet_NaN();
    CHECK(bvh.refit().lost == 40);
    spheres = original;
    spheres[7].center.y = std::numeric_limits<float>::infinity();
    CHECK(bvh.refit().lost == 1);
    spheres = original;
    const glint::Refit refit = bvh.refit();
    CHECK(refit.lost == 0);
    CHECK(refit.growth == Approx(1).epsilon(0.05));
    check_rays(bvh, 5);
  };
  check(glint::wide<8>);
  check(glint::binary);
  check(glint::quantized<4>);
}

TEST_CASE("refit of a Bvh: the set may be another one of as many primitives", "[bvh][pass]") {
  const auto before = glint::testing::scanned_blob<float>(300, 1);
  auto after = before;
  bend(after.positions);
  glint::Bvh bvh(glint::view(before));
  bvh.refit(glint::view(after), glint::TbbExecutor{2});
  CHECK(bvh.set().positions.at(0) == glint::view(after).positions.at(0));
  check_rays(bvh, 6);
}

}  // namespace test_bvh_pass_refit_layout

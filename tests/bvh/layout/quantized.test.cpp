// SPDX-License-Identifier: MIT
#include <glint/bvh/layout/quantized.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/boxes.hpp>

#include <support/catch.hpp>
#include <support/nasty_boxes.hpp>

namespace test_bvh_layout_quantized {

namespace {

using glint::Tree;

/// Any finite number: of all magnitudes, denormal ones and the largest among them.
template <typename T>
T any_finite(std::mt19937& random) {
  using Limits = std::numeric_limits<T>;
  const T sign = random() % 2 == 0 ? T(1) : T(-1);
  switch (random() % 8) {
    case 0:
      return T(0) * sign;
    case 1:
      return Limits::max() * sign;
    case 2:
      return Limits::denorm_min() * T(random() % 1000) * sign;
    case 3:
      return T(1) + Limits::epsilon() * T(random() % 1000);
    case 4:
      return T(random()) * T(0x1p-32) * sign;
    default:
      return std::ldexp(T(random()) * T(0x1p-32), int(random() % 250) - 125) * sign;
  }
}

/// How far a plane may be moved: not as far as from one mark to the next. Marks are at most twice as far apart as 255
/// need to be, and no closer than the numbers there, nor than the least normal number.
template <typename T>
long double most_moved(T lower, T upper) {
  const long double extent = static_cast<long double>(upper) - static_cast<long double>(lower);
  if (extent > static_cast<long double>(std::numeric_limits<T>::max()) / 4)
    return std::numeric_limits<long double>::infinity();
  const T far = std::max(std::abs(lower), std::abs(upper));
  const long double ulp = static_cast<long double>(far) * static_cast<long double>(std::numeric_limits<T>::epsilon());
  return 2.001L * extent / 255 + 2 * ulp + static_cast<long double>(std::numeric_limits<T>::min());
}

template <typename T>
bool is_close(T moved, T exact, long double most) {
  return std::abs(static_cast<long double>(moved) - static_cast<long double>(exact)) <= most;
}

/// The nodes of both layouts have the same places: whether those here hold those there, and hardly more.
template <int N, typename T>
void check_against_wide(const Tree<T>& tree) {
  const glint::WideNodes<T, std::uint32_t, N> wide(tree);
  const glint::QuantizedNodes<T, std::uint32_t, N> small(tree);
  REQUIRE(small.empty() == wide.empty());
  if (wide.empty()) return;
  REQUIRE(small.root() == wide.root());
  if (wide.root().is_leaf()) return;
  std::vector<std::uint32_t> pending{0};
  std::size_t wrong = 0;
  while (!pending.empty()) {
    const auto at = pending.back();
    pending.pop_back();
    const auto& exact = wide.children(at).planes;
    const glint::BoxPack<T, N> boxes = small.children(at);
    for (std::size_t i = 0; i < 6; ++i)
      for (int lane = 0; lane < N; ++lane)
        wrong +=
            std::size_t(exact[0][lane] <= exact[3][lane] && small.children(at).plane(i)[lane] != boxes.planes[i][lane]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      T lower = std::numeric_limits<T>::max();
      T upper = -lower;
      for (int i = 0; i < N; ++i) {
        lower = std::min(lower, exact[axis][i]);
        upper = std::max(upper, exact[axis + 3][i]);
      }
      for (int i = 0; i < N; ++i) {
        if (!(exact[axis][i] <= exact[axis + 3][i])) continue;
        const long double most = most_moved(lower, upper);
        const T low = boxes.planes[axis][i];
        const T high = boxes.planes[axis + 3][i];
        wrong += std::size_t(!(low <= exact[axis][i] && exact[axis + 3][i] <= high));
        wrong += std::size_t(!is_close(low, exact[axis][i], most) || !is_close(high, exact[axis + 3][i], most));
      }
    }
    for (int i = 0; i < N; ++i) {
      const bool missing = !(exact[0][i] <= exact[3][i]);
      const auto link = wide.links(at)[std::size_t(i)];
      const glint::Link<std::uint32_t> packed = small.links(at)[std::size_t(i)];
      wrong += std::size_t(missing != !(boxes.planes[0][i] <= boxes.planes[3][i]));
      if (missing) {
        wrong += std::size_t(!packed.is_leaf());  // for a ray from afar may follow it
        wrong += std::size_t(!std::isinf(boxes.planes[0][i]) || !std::isinf(boxes.planes[3][i]));
        continue;
      }
      wrong += std::size_t(packed != link);
      if (!link.is_leaf()) pending.push_back(link.first);
    }
  }
  CHECK(wrong == 0);
}

template <typename T>
void check_widths(const Tree<T>& tree) {
  check_against_wide<2>(tree);
  check_against_wide<4>(tree);
  check_against_wide<8>(tree);
  check_against_wide<16>(tree);
}

}  // namespace

TEMPLATE_TEST_CASE("quantized: a number lies between two neighboring marks", "[bvh][layout]", float, double) {
  using T = TestType;
  std::mt19937 random(3);
  for (int trial = 0; trial < 20'000; ++trial) {
    std::array<T, 3> x{any_finite<T>(random), any_finite<T>(random), any_finite<T>(random)};
    std::sort(x.begin(), x.end());
    const auto ruler = glint::detail::Ruler<T>::over(x[0], x[2]);
    const int below = ruler.at_or_below(x[1]);
    const int above = ruler.at_or_above(x[1]);
    bool good = ruler.mark(0) == x[0] && ruler.mark(255) >= x[2];
    if (ruler.is_endless()) {
      CHECK((good && below == 0 && above == 255));
      continue;
    }
    good = good && ruler.mark(below) <= x[1] && (below == 255 || ruler.mark(below + 1) > x[1]);
    good = good && ruler.mark(above) >= x[1] && (above == 0 || ruler.mark(above - 1) < x[1]);
    CAPTURE(x[0], x[1], x[2], below, above);
    if (!good) FAIL_CHECK("a mark is not the nearest one");
  }
}

TEMPLATE_TEST_CASE("quantized: boxes hold the boxes of the tree, and are less than a mark larger", "[bvh][layout]",
                   float, double) {
  for (const auto& [name, boxes] : glint::testing::nasty_boxes<TestType>()) {
    CAPTURE(name);
    check_widths(glint::BinnedSah{}.build(glint::Boxes{boxes}));
    check_widths(glint::Median{.max_leaf_size = 1}.build(glint::Boxes{boxes}));
  }
  for (const int exponent : {-148, -130, -60, 60, 120}) {  // random boxes, from denormal to nearly too large
    CAPTURE(exponent);
    auto boxes = glint::testing::random_boxes<TestType>(300, 5);
    for (auto& box : boxes)
      box = {box.lower * std::ldexp(TestType(1), exponent), box.upper * std::ldexp(TestType(1), exponent)};
    check_widths(glint::BinnedSah{}.build(glint::Boxes{boxes}));
  }
}

TEST_CASE("quantized: links to leaves too large or too far for them are kept beside", "[bvh][layout]") {
  const auto boxes = glint::testing::random_boxes<float>(2000, 6);
  check_widths(glint::Median{.max_leaf_size = 40}.build(glint::Boxes{boxes}));
  auto tree = glint::Median{.max_leaf_size = 1}.build(glint::Boxes{boxes});
  for (auto& node : tree.nodes)  // as if there were 2³² slots
    if (node.is_leaf() && node.first % 3 == 0) node.first += 0xf0000000U;
  check_widths(tree);
}

TEST_CASE("quantized: a node takes 96 bytes", "[bvh][layout]") {
  const auto tree = glint::BinnedSah{}.build(glint::Boxes{glint::testing::random_boxes<float>(5000, 7)});
  const glint::WideNodes<float, std::uint32_t, 8> wide(tree);
  const glint::QuantizedNodes<float, std::uint32_t, 8> small(tree);
  CHECK(small.bytes() * 256 == wide.bytes() * 96);
}

TEST_CASE("quantized: gives the same nodes for every executor", "[bvh][layout]") {
  using Nodes = glint::QuantizedNodes<float, std::uint32_t, 8>;
  const auto tree = glint::BinnedSah{}.build(glint::Boxes{glint::testing::random_boxes<float>(30'000, 8)});
  const Nodes one(tree);
  const Nodes two(tree, glint::Collapse::Optimal, glint::testing::TwoThreads{});
  REQUIRE(one.bytes() == two.bytes());
  bool same = true;
  for (std::uint32_t node = 0; node != one.bytes() / 96; ++node) {
    const glint::BoxPack<float, 8> a = one.children(node);
    const glint::BoxPack<float, 8> b = two.children(node);
    for (int i = 0; i < 8; ++i) {
      same = same && one.links(node)[std::size_t(i)] == two.links(node)[std::size_t(i)];
      for (std::size_t plane = 0; plane < 6; ++plane) same = same && a.planes[plane][i] == b.planes[plane][i];
    }
  }
  CHECK(same);
}

TEST_CASE("quantized: without a tree there is nothing to walk", "[bvh][layout]") {
  CHECK(glint::QuantizedNodes<float, std::uint32_t, 8>{}.empty());
  CHECK(glint::QuantizedNodes<float, std::uint32_t, 8>(Tree<float>{}).empty());
}

}  // namespace test_bvh_layout_quantized

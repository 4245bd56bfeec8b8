// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/grow.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// The surface area heuristic at every primitive, not at a few bins: the best tree that splits primitives by their
/// centers, for several times the building time of BinnedSah.
///
/// Each axis is sorted once; nodes keep the three orders by stable partitions.
///
/// Cost:    O(n log n).
/// Threads: the axes of large nodes and subtrees in parallel; the same tree for every executor.
/// Source:  Wald, Boulos, Shirley, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies", TOG 2007.
struct SweepSah {
  float traversal_cost = 0.7F;  ///< of visiting an inner node …
  float intersection_cost = 1;  ///< … against testing a primitive
  std::size_t block_size = 4;   ///< primitives that a leaf tests at the price of one: a Bvh's Leaves::block_size
  std::size_t max_leaf_size = 8;
  int max_depth = 64;  ///< clamped to 0 … Tree::max_depth

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const;
};

namespace detail {

template <std::floating_point T>
class SweepSplitter {
 public:
  template <typename Executor>
  SweepSplitter(const SweepSah& options, std::span<const Reference<T>> references, const Executor& executor)
      : options_(options), references_(references), is_left_(references.size()) {
    for_each_axis(executor, true, [this](std::size_t axis) { sort(axis); });
  }

  std::size_t max_leaf_size = 1;

  template <typename Executor>
  [[nodiscard]] std::optional<std::pair<Part<T>, Part<T>>> split(const Part<T>& part, std::size_t capacity,
                                                                 const Executor& executor) {
    const bool large = part.count > chunk_size;
    std::array<Cut, 3> cuts;
    for_each_axis(executor, large, [&](std::size_t axis) { cuts[axis] = cheapest(part, axis, capacity); });
    std::size_t axis = cuts[1].cost < cuts[0].cost ? 1 : 0;
    if (cuts[2].cost < cuts[axis].cost) axis = 2;
    Cut cut = cuts[axis];
    if (part.count <= max_leaf_size && !pays(part, cut.cost)) return std::nullopt;
    if (!(cut.cost < infinity<T>)) {
      axis = std::size_t(part.longest_axis());
      cut.left_count = part.count / 2;
    }
    partition(part, axis, cut.left_count, executor, large);
    return std::pair{measured(part, axis, 0, cut.left_count), measured(part, axis, cut.left_count, part.count)};
  }
  template <std::unsigned_integral I>
  void write(const Part<T>& part, I* order) const noexcept {
    for (std::size_t i = part.first; i != part.first + part.count; ++i)
      *order++ = I(references_[sorted_[0][i]].index());
  }

 private:
  using Position = typename Reference<T>::Bits;  // of a reference

  struct Cut {
    T cost = infinity<T>;
    std::size_t left_count = 0;
  };

  template <typename Executor, typename Body>
  static void for_each_axis(const Executor& executor, bool large, const Body& body) {
    const auto run = [&](std::size_t begin, std::size_t end) {
      for (std::size_t axis = begin; axis != end; ++axis) body(axis);
    };
    if (large)
      executor.parallel_for(3, 1, run);
    else
      run(0, 3);
  }

  void sort(std::size_t axis) {
    std::vector<std::pair<T, Position>> keys(references_.size());
    for (std::size_t i = 0; i != keys.size(); ++i) keys[i] = {references_[i].center(int(axis)), Position(i)};
    std::sort(keys.begin(), keys.end());
    sorted_[axis].resize(keys.size());
    scratch_[axis].resize(keys.size());
    right_cost_[axis].resize(keys.size());
    for (std::size_t i = 0; i != keys.size(); ++i) sorted_[axis][i] = keys[i].second;
  }

  /// The cheapest cut with at most `capacity` references on either side.
  [[nodiscard]] Cut cheapest(const Part<T>& part, std::size_t axis, std::size_t capacity) noexcept {
    const Position* order = sorted_[axis].data() + part.first;
    T* right_cost = right_cost_[axis].data() + part.first;
    PackedBox<T> side = PackedBox<T>::empty();
    for (std::size_t i = part.count - 1; i > 0; --i) {
      const Reference<T>& r = references_[order[i]];
      side.extend(r.lower, r.upper);
      right_cost[i] = side.half_area() * T(blocks(part.count - i, options_.block_size));
    }
    Cut best;
    side = PackedBox<T>::empty();
    for (std::size_t i = 1; i < part.count; ++i) {
      const Reference<T>& r = references_[order[i - 1]];
      side.extend(r.lower, r.upper);
      const T cost = side.half_area() * T(blocks(i, options_.block_size)) + right_cost[i];
      if (cost < best.cost && std::max(i, part.count - i) <= capacity) best = {cost, i};
    }
    return best;
  }
  [[nodiscard]] bool pays(const Part<T>& part, T cut_cost) const noexcept {
    const T area = part.box.half_area();
    return T(options_.traversal_cost) * area + T(options_.intersection_cost) * cut_cost <
           T(options_.intersection_cost) * area * T(blocks(part.count, options_.block_size));
  }

  template <typename Executor>
  void partition(const Part<T>& part, std::size_t axis, std::size_t left_count, const Executor& executor, bool large) {
    const Position* order = sorted_[axis].data() + part.first;
    for (std::size_t i = 0; i != part.count; ++i) is_left_[order[i]] = std::uint8_t(i < left_count);
    for_each_axis(executor, large, [&](std::size_t other) {
      if (other == axis) return;
      Position* run = sorted_[other].data() + part.first;
      Position* right = scratch_[other].data() + part.first;
      Position* const right_begin = right;
      Position* left = run;
      for (std::size_t i = 0; i != part.count; ++i) {
        const Position p = run[i];
        const bool goes_left = is_left_[p] != 0;
        *left = p;  // both written, one kept: no branch to guess
        *right = p;
        left += goes_left;
        right += !goes_left;
      }
      std::copy(right_begin, right, left);
    });
  }
  [[nodiscard]] Part<T> measured(const Part<T>& part, std::size_t axis, std::size_t begin,
                                 std::size_t end) const noexcept {
    Part<T> result{.first = part.first + begin, .count = end - begin};
    for (std::size_t i = part.first + begin; i != part.first + end; ++i) result.extend(references_[sorted_[axis][i]]);
    return result;
  }

  SweepSah options_;
  std::span<const Reference<T>> references_;
  std::array<std::vector<Position>, 3> sorted_;
  std::array<std::vector<Position>, 3> scratch_;
  std::array<std::vector<T>, 3> right_cost_;
  std::vector<std::uint8_t> is_left_;
};

}  // namespace detail

template <BoundedSet S, Executor E>
Tree<typename S::Scalar, typename S::Index> SweepSah::build(const S& set, const E& executor) const {
  using T = typename S::Scalar;
  return detail::grow_tree(
      set, executor,
      [&](detail::References<T>& r, const auto& /*root*/) { return detail::SweepSplitter<T>(*this, r, executor); },
      max_leaf_size, max_depth);
}

}  // namespace glint

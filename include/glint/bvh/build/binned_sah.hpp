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
#include <glint/simd/pack.hpp>

namespace glint {

/// The surface area heuristic over a few equally wide bins an axis: nearly the rays of a full sweep for a fraction of
/// the time. The default builder.
///
/// Cost:    O(n log n).
/// Threads: large nodes and subtrees in parallel; the same tree for every executor.
/// Source:  Wald, "On fast Construction of SAH-based Bounding Volume Hierarchies", Interactive Ray Tracing 2007.
struct BinnedSah {
  int bins = 16;                ///< an axis, in large nodes; clamped to 2 … 32
  float traversal_cost = 0.7F;  ///< of visiting an inner node …
  float intersection_cost = 1;  ///< … against testing a primitive
  std::size_t block_size = 4;   ///< primitives that a leaf tests at the price of one: TriangleBlocks takes 4
  std::size_t max_leaf_size = 8;
  int max_depth = 64;  ///< clamped to 0 … Tree::max_depth

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const;
};

namespace detail {

inline constexpr int max_bins = 32;

/// Which bin of a part a center falls into, along each axis.
template <std::floating_point T>
struct Binning {
  int bins;
  Pack<T, 4> origin;
  Pack<T, 4> scale;
  Pack<T, 4> last;

  Binning(const Part<T>& part, int max) noexcept
      : bins(int(std::min<std::size_t>(std::size_t(max), 4 + part.count / 16))),
        origin(part.centers.lower),
        scale(Pack<T, 4>::broadcast(T(0))),
        last(Pack<T, 4>::broadcast(T(bins - 1))) {
    for (int axis = 0; axis < 3; ++axis) {
      const T s = T(bins) / (part.centers.upper[axis] - part.centers.lower[axis]);
      if (s <= std::numeric_limits<T>::max()) scale.set(axis, s);  // else everything is in bin 0
    }
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE std::array<std::int32_t, 4> operator()(const Reference<T>& r) const noexcept {
    return truncated(min((r.center() - origin) * scale, last));
  }
};

/// Boxes and counts of the bins of all axes. Not initialized beyond the bins in use.
template <std::floating_point T>
struct Bins {
  std::array<std::array<PackedBox<T>, max_bins>, 3> box;
  std::array<std::array<std::size_t, max_bins>, 3> count;

  explicit Bins(int bins) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::fill_n(box[axis].begin(), bins, PackedBox<T>::empty());
      std::fill_n(count[axis].begin(), bins, std::size_t{0});
    }
  }
  void add(std::span<const Reference<T>> references, const Binning<T>& binning) noexcept {
    for (const Reference<T>& r : references) {
      const auto bin = binning(r);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        box[axis][std::size_t(bin[axis])].extend(r.lower, r.upper);
        ++count[axis][std::size_t(bin[axis])];
      }
    }
  }
  void add(const Bins& other, int bins) noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (std::size_t bin = 0; bin < std::size_t(bins); ++bin) {
        box[axis][bin].extend(other.box[axis][bin]);
        count[axis][bin] += other.count[axis][bin];
      }
    }
  }
};

/// A plane between two bins, and Σ area · count of the two sides.
template <std::floating_point T>
struct BinPlane {
  T cost = infinity<T>;
  std::size_t axis = 0;
  std::int32_t right = 0;  ///< the first bin of the right side
  std::size_t left_count = 0;
};

/// The cheapest plane with something on both sides; an infinite cost where there is none.
template <std::floating_point T>
[[nodiscard]] BinPlane<T> best_plane(const Bins<T>& bins, int size, std::size_t block_size) noexcept {
  BinPlane<T> best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& box = bins.box[axis];
    const auto& count = bins.count[axis];
    std::array<T, max_bins> right_cost;
    PackedBox<T> side = PackedBox<T>::empty();
    std::size_t n = 0;
    for (std::size_t i = std::size_t(size) - 1; i > 0; --i) {
      side.extend(box[i]);
      n += count[i];
      right_cost[i] = n == 0 ? infinity<T> : side.half_area() * T(blocks(n, block_size));
    }
    side = PackedBox<T>::empty();
    n = 0;
    for (std::size_t i = 1; i < std::size_t(size); ++i) {
      side.extend(box[i - 1]);
      n += count[i - 1];
      const T cost = side.half_area() * T(blocks(n, block_size)) + right_cost[i];
      if (n != 0 && cost < best.cost) best = {cost, axis, std::int32_t(i), n};
    }
  }
  return best;
}

template <std::floating_point T>
class BinnedSplitter {
 public:
  BinnedSplitter(const BinnedSah& options, std::vector<Reference<T>>& references)
      : options_(options),
        references_(references),
        scratch_(references.size() > parallel_size ? references.size() : 0) {}

  std::size_t max_leaf_size = 1;

  template <typename Executor>
  [[nodiscard]] std::optional<std::pair<Part<T>, Part<T>>> split(const Part<T>& part, std::size_t capacity,
                                                                 const Executor& executor) {
    const Binning<T> binning(part, std::clamp(options_.bins, 2, max_bins));
    const BinPlane<T> plane = best_plane(filled(part, binning, executor), binning.bins, options_.block_size);
    if (part.count <= max_leaf_size && !pays(part, plane.cost)) return std::nullopt;
    const bool fits = plane.cost < infinity<T> && std::max(plane.left_count, part.count - plane.left_count) <= capacity;
    if (!fits) return halve<T>(run(part), part);
    return part.count > parallel_size ? partition_into_other(part, binning, plane, executor)
                                      : partition_in_place(part, binning, plane);
  }
  template <std::unsigned_integral I>
  void write(const Part<T>& part, I* order) noexcept {
    for (const Reference<T>& r : run(part)) *order++ = I(r.index());
  }

 private:
  static constexpr std::size_t parallel_size = 2 * chunk_size;

  [[nodiscard]] std::span<Reference<T>> run(const Part<T>& part) noexcept {
    return std::span(part.in_scratch ? scratch_ : references_).subspan(part.first, part.count);
  }
  [[nodiscard]] bool pays(const Part<T>& part, T plane_cost) const noexcept {
    const T area = part.box.half_area();
    return T(options_.traversal_cost) * area + T(options_.intersection_cost) * plane_cost <
           T(options_.intersection_cost) * area * T(blocks(part.count, options_.block_size));
  }

  template <typename Executor>
  [[nodiscard]] Bins<T> filled(const Part<T>& part, const Binning<T>& binning, const Executor& executor) {
    Bins<T> bins(binning.bins);
    const std::span<Reference<T>> references = run(part);
    if (part.count <= parallel_size) {
      bins.add(references, binning);
      return bins;
    }
    std::vector<Bins<T>> partial(chunks(part.count), bins);
    for_each_chunk(part.count, executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      partial[chunk].add(references.subspan(begin, end - begin), binning);
    });
    for (const Bins<T>& other : partial) bins.add(other, binning.bins);
    return bins;
  }

  [[nodiscard]] std::pair<Part<T>, Part<T>> partition_in_place(const Part<T>& part, const Binning<T>& binning,
                                                               const BinPlane<T>& plane) noexcept {
    const std::span<Reference<T>> references = run(part);
    const auto is_left = [&](const Reference<T>& r) { return binning(r)[plane.axis] < plane.right; };
    Part<T> left{.first = part.first, .in_scratch = part.in_scratch};
    Part<T> right = left;
    std::size_t begin = 0;
    std::size_t end = references.size();
    while (begin != end) {
      if (is_left(references[begin])) {
        left.extend(references[begin++]);
      } else {
        right.extend(references[begin]);
        std::swap(references[begin], references[--end]);
      }
    }
    left.count = begin;
    right.first = part.first + begin;
    right.count = part.count - begin;
    return {left, right};
  }

  /// A stable partition by chunks, from one array into the other.
  template <typename Executor>
  [[nodiscard]] std::pair<Part<T>, Part<T>> partition_into_other(const Part<T>& part, const Binning<T>& binning,
                                                                 const BinPlane<T>& plane, const Executor& executor) {
    const std::span<const Reference<T>> from = run(part);
    Part<T> left{.first = part.first, .count = plane.left_count, .in_scratch = !part.in_scratch};
    Part<T> right{
        .first = part.first + plane.left_count, .count = part.count - plane.left_count, .in_scratch = !part.in_scratch};
    const std::span<Reference<T>> to =
        std::span(left.in_scratch ? scratch_ : references_).subspan(part.first, part.count);
    const auto is_left = [&](const Reference<T>& r) { return binning(r)[plane.axis] < plane.right; };
    std::vector<std::size_t> lefts(chunks(part.count));
    for_each_chunk(part.count, executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      lefts[chunk] =
          std::size_t(std::count_if(from.begin() + std::ptrdiff_t(begin), from.begin() + std::ptrdiff_t(end), is_left));
    });
    std::size_t before = 0;
    for (std::size_t& n : lefts) before += std::exchange(n, before);  // now: how many are left before the chunk
    std::vector<std::pair<Part<T>, Part<T>>> sides(lefts.size());
    for_each_chunk(part.count, executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
      std::size_t next_left = lefts[chunk];
      std::size_t next_right = plane.left_count + begin - lefts[chunk];
      std::pair<Part<T>, Part<T>> side;
      for (std::size_t i = begin; i != end; ++i) {
        const bool goes_left = is_left(from[i]);
        (goes_left ? side.first : side.second).extend(from[i]);
        to[goes_left ? next_left++ : next_right++] = from[i];
      }
      sides[chunk] = side;
    });
    for (const auto& [l, r] : sides) {
      left.extend(l);
      right.extend(r);
    }
    return {left, right};
  }

  BinnedSah options_;
  std::span<Reference<T>> references_;
  std::vector<Reference<T>> scratch_;
};

}  // namespace detail

template <BoundedSet S, Executor E>
Tree<typename S::Scalar, typename S::Index> BinnedSah::build(const S& set, const E& executor) const {
  using T = typename S::Scalar;
  return detail::grow_tree(
      set, executor, [this](std::vector<detail::Reference<T>>& r) { return detail::BinnedSplitter<T>(*this, r); },
      max_leaf_size, max_depth);
}

}  // namespace glint

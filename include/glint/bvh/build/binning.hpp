// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/config.hpp>
#include <glint/math/constants.hpp>
#include <glint/simd/pack.hpp>

namespace glint::detail {

inline constexpr int max_bins = 32;

/// Parts of more references than this are worth several threads.
inline constexpr std::size_t parallel_size = 2 * chunk_size;

/// How many bins a part gets of those that an option asks for.
[[nodiscard]] inline int bins_for(std::size_t count, int asked) noexcept {
  return int(std::min<std::size_t>(std::size_t(std::clamp(asked, 2, max_bins)), 4 + count / 16));
}

/// Bins a unit of length: zero for an axis of no extent, or of too little to be told apart, where all is in bin 0.
template <std::floating_point T>
[[nodiscard]] Pack<T, 4> bin_scale(const PackedBox<T>& box, int bins) noexcept {
  auto scale = Pack<T, 4>::broadcast(T(0));
  for (int axis = 0; axis < 3; ++axis) {
    const T s = T(bins) / (box.upper[axis] - box.lower[axis]);
    if (s <= std::numeric_limits<T>::max()) scale.set(axis, s);
  }
  return scale;
}

/// Which bin of a part a center falls into, along each axis.
template <std::floating_point T>
struct Binning {
  int bins;
  Pack<T, 4> origin;
  Pack<T, 4> scale;
  Pack<T, 4> last;

  Binning(const Part<T>& part, int asked) noexcept
      : bins(bins_for(part.count, asked)),
        origin(part.centers.lower),
        scale(bin_scale(part.centers, bins)),
        last(Pack<T, 4>::broadcast(T(bins - 1))) {}
  [[nodiscard]] GLINT_ALWAYS_INLINE std::array<std::int32_t, 4> operator()(const Reference<T>& r) const noexcept {
    return truncated(min((r.center() - origin) * scale, last));
  }
};

template <std::floating_point T>
using BinBoxes = std::array<std::array<PackedBox<T>, max_bins>, 3>;
using BinCounts = std::array<std::array<std::size_t, max_bins>, 3>;

template <std::floating_point T>
void clear(BinBoxes<T>& boxes, int bins) noexcept {
  for (auto& axis : boxes) std::fill_n(axis.begin(), bins, PackedBox<T>::empty());
}
inline void clear(BinCounts& counts, int bins) noexcept {
  for (auto& axis : counts) std::fill_n(axis.begin(), bins, std::size_t{0});
}
template <std::floating_point T>
void merge(BinBoxes<T>& boxes, const BinBoxes<T>& others, int bins) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t bin = 0; bin < std::size_t(bins); ++bin) boxes[axis][bin].extend(others[axis][bin]);
}
inline void merge(BinCounts& counts, const BinCounts& others, int bins) noexcept {
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t bin = 0; bin < std::size_t(bins); ++bin) counts[axis][bin] += others[axis][bin];
}

/// Boxes and counts of the bins of all axes. Not initialized beyond the bins in use.
template <std::floating_point T>
struct Bins {
  BinBoxes<T> box;
  BinCounts count;

  explicit Bins(int bins) noexcept {
    clear(box, bins);
    clear(count, bins);
  }
  void add(const Reference<T>& r, const Binning<T>& binning) noexcept {
    const auto bin = binning(r);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box[axis][std::size_t(bin[axis])].extend(r.lower, r.upper);
      ++count[axis][std::size_t(bin[axis])];
    }
  }
  void add(const Bins& other, int bins) noexcept {
    merge(box, other.box, bins);
    merge(count, other.count, bins);
  }
};

/// Bins of all references, those of many by chunks.
template <typename B, std::floating_point T, typename BinningOf, typename Executor>
[[nodiscard]] B filled(std::span<const Reference<T>> references, const BinningOf& binning, const Executor& executor) {
  B all(binning.bins);
  if (references.size() <= parallel_size) {
    for (const Reference<T>& r : references) all.add(r, binning);
    return all;
  }
  std::vector<B> partial(chunks(references.size()), all);
  for_each_chunk(references.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    for (const Reference<T>& r : references.subspan(begin, end - begin)) partial[chunk].add(r, binning);
  });
  for (const B& other : partial) all.add(other, binning.bins);
  return all;
}

/// A plane between two bins, and Σ area · count of the two sides.
template <std::floating_point T>
struct BinPlane {
  T cost = infinity<T>;
  std::size_t axis = 0;
  std::int32_t right = 0;  ///< the first bin of the right side
  std::size_t left_count = 0;
  std::size_t right_count = 0;

  /// Whether there is a plane, and no side has more than `capacity`.
  [[nodiscard]] bool fits(std::size_t capacity) const noexcept {
    return cost < infinity<T> && std::max(left_count, right_count) <= capacity;
  }
};

/// The cheapest plane with something on both sides; an infinite cost where there is none. What is in several bins is
/// counted where it begins, and where it ends; no plane counts more than `most`.
template <std::floating_point T>
[[nodiscard]] BinPlane<T> best_plane(const BinBoxes<T>& boxes, const BinCounts& begins, const BinCounts& ends, int bins,
                                     std::size_t block_size, std::size_t most) noexcept {
  BinPlane<T> best;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto& box = boxes[axis];
    std::array<T, max_bins> right_cost;
    std::array<std::size_t, max_bins> right_count;
    PackedBox<T> side = PackedBox<T>::empty();
    std::size_t n = 0;
    for (std::size_t i = std::size_t(bins) - 1; i > 0; --i) {
      side.extend(box[i]);
      n += ends[axis][i];
      right_cost[i] = n == 0 ? infinity<T> : fenced(side.half_area() * T(blocks(n, block_size)));
      right_count[i] = n;
    }
    side = PackedBox<T>::empty();
    n = 0;
    for (std::size_t i = 1; i < std::size_t(bins); ++i) {
      side.extend(box[i - 1]);
      n += begins[axis][i - 1];
      const T cost = fenced(side.half_area() * T(blocks(n, block_size))) + right_cost[i];
      if (n != 0 && cost < best.cost && n + right_count[i] <= most)
        best = {cost, axis, std::int32_t(i), n, right_count[i]};
    }
  }
  return best;
}

/// The boxes of what is left and right of a plane.
template <std::floating_point T>
[[nodiscard]] std::pair<PackedBox<T>, PackedBox<T>> sides(const BinBoxes<T>& boxes, const BinPlane<T>& plane,
                                                          int bins) noexcept {
  std::pair both{PackedBox<T>::empty(), PackedBox<T>::empty()};
  for (int bin = 0; bin < bins; ++bin)
    (bin < plane.right ? both.first : both.second).extend(boxes[plane.axis][std::size_t(bin)]);
  return both;
}

/// Whether two children are cheaper than a leaf.
template <std::floating_point T, typename Options>
[[nodiscard]] bool pays(const Options& options, const Part<T>& part, T plane_cost) noexcept {
  const T area = part.box.half_area();
  return fenced(T(options.traversal_cost) * area) + fenced(T(options.intersection_cost) * plane_cost) <
         T(options.intersection_cost) * area * T(blocks(part.count, options.block_size));
}

}  // namespace glint::detail

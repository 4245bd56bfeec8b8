// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include <glint/bvh/build/binning.hpp>
#include <glint/bvh/build/deal.hpp>
#include <glint/bvh/build/grow.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// BinnedSah that may also cut primitives in two at a plane, where their boxes overlap much: the best tree for rays
/// where primitives are long, large or of many sizes, as in buildings. A primitive may then be in several leaves.
///
/// Sets that are ClippableSet have their primitives cut exactly; of others, the boxes are cut.
///
/// Cost:    O(n log n).
/// Threads: large nodes and subtrees in parallel; the same tree for every executor.
/// Source:  Stich, Friedrich, Dietrich, "Spatial Splits in Bounding Volume Hierarchies", HPG 2009. Deviates: planes are
///          tried half as many as for centers, only where the smaller child is overlapped for the most part, and only
///          those within a budget, of which each child gets a share by its count.
struct SpatialSah {
  int bins = 16;                ///< an axis, in large nodes; clamped to 2 … 32
  float traversal_cost = 0.7F;  ///< of visiting an inner node …
  float intersection_cost = 1;  ///< … against testing a primitive
  std::size_t block_size = 4;   ///< primitives that a leaf tests at the price of one: a Bvh's Leaves::block_size
  std::size_t max_leaf_size = 8;
  int max_depth = 64;               ///< clamped to 0 … Tree::max_depth
  float memory_budget = 1.3F;       ///< slots in leaves, at most, as a multiple of the primitives
  float min_overlap = 1e-4F;        ///< of two children's boxes, for planes to be tried: in areas of the root's box …
  float min_child_overlap = 0.55F;  ///< … and of the smaller child's

  template <BoundedSet S, Executor E = Serial>
  [[nodiscard]] Tree<typename S::Scalar, typename S::Index> build(const S& set, const E& executor = {}) const;
};

namespace detail {

/// The box of what a primitive has in a cell, which is part of its box; the cell itself where that is not known.
template <BoundedSet S>
[[nodiscard]] PackedBox<typename S::Scalar> clipped(const S& set, std::size_t i,
                                                    const PackedBox<typename S::Scalar>& cell) {
  if constexpr (ClippableSet<S>) {
    using T = typename S::Scalar;
    const Aabb<T> box = cell.box();
    return PackedBox<T>(overlap(box, set.clip(typename S::Index(i), box)));
  } else {
    return cell;
  }
}

/// In which bins of a part a box begins and ends, along each axis.
template <BoundedSet S>
struct SpatialBinning {
  using T = typename S::Scalar;
  const S& set;
  int bins;
  Pack<T, 4> origin;
  Pack<T, 4> scale;
  Pack<T, 4> width;
  Pack<T, 4> last;

  SpatialBinning(const S& of, const Part<T>& part, int asked) noexcept
      : set(of),
        bins(bins_for(part.count, asked)),
        origin(part.box.lower),
        scale(bin_scale(part.box, bins)),
        width((part.box.upper - part.box.lower) * Pack<T, 4>::broadcast(T(1) / T(bins))),
        last(Pack<T, 4>::broadcast(T(bins - 1))) {
    origin.set(3, T(0));
  }
  /// What sticks out of a bin by less than a thousandth of its width is not worth a cut.
  [[nodiscard]] GLINT_ALWAYS_INLINE std::array<std::int32_t, 4> first(const Reference<T>& r) const noexcept {
    return truncated(min(fenced((r.corner() - origin) * scale) + Pack<T, 4>::broadcast(margin), last));
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE std::array<std::int32_t, 4> end(const Reference<T>& r) const noexcept {
    return truncated(min(fenced((r.upper - origin) * scale) - Pack<T, 4>::broadcast(margin), last));
  }
  /// Where a bin begins.
  [[nodiscard]] GLINT_ALWAYS_INLINE T plane(std::size_t axis, std::int32_t bin) const noexcept {
    return origin[int(axis)] + fenced(T(bin) * width[int(axis)]);
  }

 private:
  static constexpr T margin = T(0x1p-10);
};

/// Boxes of what primitives have in the bins, and how many begin and end there.
template <BoundedSet S>
struct SpatialBins {
  using T = typename S::Scalar;
  BinBoxes<T> box;
  BinCounts begins;
  BinCounts ends;

  explicit SpatialBins(int bins) noexcept {
    clear(box, bins);
    clear(begins, bins);
    clear(ends, bins);
  }
  void add(const Reference<T>& r, const SpatialBinning<S>& binning) {
    const auto first = binning.first(r);
    const auto end = binning.end(r);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int32_t last = std::max(first[axis], end[axis]);
      ++begins[axis][std::size_t(first[axis])];
      ++ends[axis][std::size_t(last)];
      if (first[axis] == last)
        box[axis][std::size_t(last)].extend(r.lower, r.upper);
      else
        add_parts(r, binning, axis, first[axis], last);
    }
  }
  void add(const SpatialBins& other, int bins) noexcept {
    merge(box, other.box, bins);
    merge(begins, other.begins, bins);
    merge(ends, other.ends, bins);
  }

 private:
  void add_parts(const Reference<T>& r, const SpatialBinning<S>& binning, std::size_t axis, std::int32_t first,
                 std::int32_t last) {
    const int a = int(axis);
    PackedBox<T> cell{r.lower, r.upper};
    for (std::int32_t bin = first; bin <= last; ++bin) {
      cell.upper.set(a, bin == last ? r.upper[a] : binning.plane(axis, bin + 1));
      PackedBox<T>& filled = box[axis][std::size_t(bin)];
      if (!filled.contains(cell)) filled.extend(clipped(binning.set, r.index(), cell));
      cell.lower.set(a, cell.upper[a]);
    }
  }
};

/// Cuts references at a plane between two bins, but for those that are cheaper to put on one side whole.
template <BoundedSet S>
class PlaneDealer {
 public:
  using T = typename S::Scalar;
  static constexpr bool cuts = true;

  PlaneDealer(const SpatialBinning<S>& binning, const SpatialBins<S>& bins, const BinPlane<T>& plane) noexcept
      : binning_(binning),
        plane_(plane),
        at_(binning.plane(plane.axis, plane.right)),
        left_count_(T(plane.left_count)),
        right_count_(T(plane.right_count)) {
    std::tie(left_, right_) = sides(bins.box, plane, binning.bins);
    left_area_ = left_.half_area();
    right_area_ = right_.half_area();
  }

  [[nodiscard]] Side side(const Reference<T>& r) const noexcept {
    const std::int32_t first = binning_.first(r)[plane_.axis];
    if (first >= plane_.right) return Side::Right;
    if (std::max(first, binning_.end(r)[plane_.axis]) < plane_.right) return Side::Left;
    PackedBox<T> left = left_;
    PackedBox<T> right = right_;
    left.extend(r.lower, r.upper);
    right.extend(r.lower, r.upper);
    const T if_both = fenced(left_area_ * left_count_) + fenced(right_area_ * right_count_);
    const T if_left = fenced(left.half_area() * left_count_) + fenced(right_area_ * (right_count_ - T(1)));
    const T if_right = fenced(left_area_ * (left_count_ - T(1))) + fenced(right.half_area() * right_count_);
    if (if_both < if_left && if_both < if_right) return Side::Both;
    return if_left <= if_right ? Side::Left : Side::Right;
  }
  [[nodiscard]] std::pair<Reference<T>, Reference<T>> cut(const Reference<T>& r) const {
    PackedBox<T> left{r.lower, r.upper};
    PackedBox<T> right = left;
    const T at = std::clamp(at_, r.lower[int(plane_.axis)], r.upper[int(plane_.axis)]);
    left.upper.set(int(plane_.axis), at);
    right.lower.set(int(plane_.axis), at);
    return {part(r, left), part(r, right)};
  }

 private:
  /// A primitive that shows nothing in the cell, though its box did, keeps the cell.
  [[nodiscard]] Reference<T> part(const Reference<T>& r, const PackedBox<T>& cell) const {
    const Aabb<T> box = clipped(binning_.set, r.index(), cell).box();
    return Reference<T>(is_empty(box) ? cell.box() : box, r.index());
  }

  const SpatialBinning<S>& binning_;
  BinPlane<T> plane_;
  T at_;
  T left_count_;
  T right_count_;
  PackedBox<T> left_;
  PackedBox<T> right_;
  T left_area_;
  T right_area_;
};

template <BoundedSet S>
class SpatialSplitter {
 public:
  using T = typename S::Scalar;
  using Parts = std::pair<Part<T>, Part<T>>;

  SpatialSplitter(const SpatialSah& options, const S& set, References<T>& references, const Part<T>& root)
      : options_(options), set_(set), min_overlap_(T(options.min_overlap) * root.box.half_area()) {
    const std::size_t count = references.size();
    constexpr auto last = std::numeric_limits<typename S::Index>::max() / 2;  // nodes are twice as many
    const double most = std::min(double(last), double(count) * double(options.memory_budget));
    references.resize(std::size_t(std::max(double(count), most)));
    references_ = references;
    scratch_.resize(references.size());
  }

  std::size_t max_leaf_size = 1;

  template <typename Executor>
  [[nodiscard]] std::optional<Parts> split(const Part<T>& part, std::size_t capacity, const Executor& executor) {
    const Binning<T> binning(part, options_.bins);
    const Bins<T> bins = filled<Bins<T>, T>(run(part), binning, executor);
    const BinPlane<T> plane =
        best_plane(bins.box, bins.count, bins.count, binning.bins, options_.block_size, part.count);
    if (part.spare != 0 && part.count > options_.block_size && overlaps_much(bins, plane, binning.bins)) {
      if (auto cut = split_by_plane(part, plane.cost, capacity, executor)) return cut;
    }
    if (part.count <= max_leaf_size && !pays(options_, part, plane.cost)) return std::nullopt;
    if (!plane.fits(capacity)) return halved(part);
    return deal<T>(part, right_begin(part, plane), CenterDealer<T>{binning, plane}, run(part), other_slots(part),
                   executor);
  }
  template <std::unsigned_integral I>
  void write(const Part<T>& part, I* order) noexcept {
    for (const Reference<T>& r : run(part)) *order++ = I(r.index());
  }

 private:
  [[nodiscard]] std::span<Reference<T>> run(const Part<T>& part) noexcept {
    return std::span(part.in_scratch ? scratch_ : references_).subspan(part.first, part.count);
  }
  /// The part's slots, the spare ones too, in the other array.
  [[nodiscard]] std::span<Reference<T>> other_slots(const Part<T>& part) noexcept {
    return std::span(part.in_scratch ? references_ : std::span(scratch_)).subspan(part.first, part.count + part.spare);
  }
  /// Spare slots are shared in proportion to the references.
  [[nodiscard]] static std::size_t right_begin(const Part<T>& part, const BinPlane<T>& plane) noexcept {
    const std::size_t both = plane.left_count + plane.right_count;
    const std::size_t spare = part.count + part.spare - both;
    return plane.left_count + std::size_t(double(spare) * (double(plane.left_count) / double(both)));
  }
  [[nodiscard]] Parts halved(const Part<T>& part) {
    Parts halves = halve<T>(run(part), part);
    halves.second.spare = part.spare;
    return halves;
  }

  /// Whether cutting may help where `plane` tells primitives apart by their centers.
  [[nodiscard]] bool overlaps_much(const Bins<T>& bins, const BinPlane<T>& plane, int count) const noexcept {
    if (!(plane.cost < infinity<T>)) return true;
    const auto [left, right] = sides(bins.box, plane, count);
    const T area = half_area(overlap(left.box(), right.box()));
    return area > min_overlap_ && area > T(options_.min_child_overlap) * std::min(left.half_area(), right.half_area());
  }

  template <typename Executor>
  [[nodiscard]] std::optional<Parts> split_by_plane(const Part<T>& part, T cost_to_beat, std::size_t capacity,
                                                    const Executor& executor) {
    const SpatialBinning<S> binning(set_, part, options_.bins / 2);
    const auto bins = filled<SpatialBins<S>, T>(run(part), binning, executor);
    const BinPlane<T> plane =
        best_plane(bins.box, bins.begins, bins.ends, binning.bins, options_.block_size, part.count + part.spare);
    if (!(plane.cost < cost_to_beat) || !plane.fits(capacity)) return std::nullopt;
    if (part.count <= max_leaf_size && !pays(options_, part, plane.cost)) return std::nullopt;
    const Parts parts = deal<T>(part, right_begin(part, plane), PlaneDealer<S>(binning, bins, plane), run(part),
                                other_slots(part), executor);
    if (parts.first.count == 0 || parts.second.count == 0) return std::nullopt;
    return parts;
  }

  SpatialSah options_;
  const S& set_;
  T min_overlap_;
  std::span<Reference<T>> references_;
  References<T> scratch_;
};

}  // namespace detail

template <BoundedSet S, Executor E>
Tree<typename S::Scalar, typename S::Index> SpatialSah::build(const S& set, const E& executor) const {
  using T = typename S::Scalar;
  return detail::grow_tree(
      set, executor,
      [&](detail::References<T>& r, const detail::Part<T>& root) {
        return detail::SpatialSplitter<S>(*this, set, r, root);
      },
      max_leaf_size, max_depth);
}

}  // namespace glint

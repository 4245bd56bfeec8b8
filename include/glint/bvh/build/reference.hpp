// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/core/config.hpp>
#include <glint/core/uninitialized.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint::detail {

/// A box in two registers; the fourth lane is nobody's. What builders compare is fenced, so that no tree depends on
/// how a compiler fuses in the code it makes for an executor.
template <std::floating_point T, int W = Pack<T, 4>::width>
struct PackedBox {
  Pack<T, 4> lower;
  Pack<T, 4> upper;

  PackedBox() = default;
  PackedBox(const Pack<T, 4>& low, const Pack<T, 4>& high) noexcept : lower(low), upper(high) {}
  explicit PackedBox(const Aabb<T>& box) noexcept {
    lower = Pack<T, 4>::broadcast(T(0));
    upper = lower;
    for (int axis = 0; axis < 3; ++axis) {
      lower.set(axis, component(box.lower, axis));
      upper.set(axis, component(box.upper, axis));
    }
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE static PackedBox empty() noexcept {
    return {Pack<T, 4>::broadcast(infinity<T>), Pack<T, 4>::broadcast(-infinity<T>)};
  }
  GLINT_ALWAYS_INLINE void extend(const Pack<T, 4>& low, const Pack<T, 4>& high) noexcept {
    lower = min(low, lower);
    upper = max(high, upper);
  }
  GLINT_ALWAYS_INLINE void extend(const PackedBox& other) noexcept { extend(other.lower, other.upper); }

  [[nodiscard]] Aabb<T> box() const noexcept {
    return {{lower[0], lower[1], lower[2]}, {upper[0], upper[1], upper[2]}};
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE bool contains(const PackedBox& other) const noexcept {
    return ((less(other.lower, lower) | less(upper, other.upper)) & 7U) == 0;
  }
  /// Zero for an empty box.
  [[nodiscard]] GLINT_ALWAYS_INLINE T half_area() const noexcept {
    const Pack<T, 4> e = max(upper - lower, Pack<T, 4>::broadcast(T(0)));
    return fenced(e[0] * (e[1] + e[2])) + fenced(e[1] * e[2]);
  }
};

/// A primitive as builders move it about: its box, and its index in the bits of the lower corner's fourth lane.
template <std::floating_point T, int W = Pack<T, 4>::width>
struct Reference {
  using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;

  Pack<T, 4> lower;
  Pack<T, 4> upper;

  Reference() = default;
  Reference(const Aabb<T>& box, std::size_t index) noexcept {
    const std::array<T, 4> low{box.lower.x, box.lower.y, box.lower.z, std::bit_cast<T>(Bits(index))};
    const std::array<T, 4> high{box.upper.x, box.upper.y, box.upper.z, T(0)};
    lower = Pack<T, 4>::load(low.data());
    upper = Pack<T, 4>::load(high.data());
  }
  [[nodiscard]] std::size_t index() const noexcept { return std::size_t(std::bit_cast<Bits>(lower[3])); }
  /// The lower corner, with zero in the fourth lane.
  [[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, 4> corner() const noexcept {
    Pack<T, 4> low = lower;
    low.set(3, T(0));
    return low;
  }
  /// Half of each corner first, so that boxes near the largest number have a center. The fourth lane is zero.
  [[nodiscard]] GLINT_ALWAYS_INLINE Pack<T, 4> center() const noexcept {
    const Pack<T, 4> half = Pack<T, 4>::broadcast(T(0.5));
    return corner() * half + upper * half;
  }
  [[nodiscard]] GLINT_ALWAYS_INLINE T center(int axis) const noexcept {
    return lower[axis] * T(0.5) + upper[axis] * T(0.5);
  }
};

/// What a builder moves about.
template <std::floating_point T>
using References = UninitializedVector<Reference<T>>;

/// A run of references, which becomes a leaf of these slots or is split.
template <std::floating_point T, int W = Pack<T, 4>::width>
struct Part {
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t spare = 0;  ///< slots after its own, for those that splitting planes add
  PackedBox<T> box = PackedBox<T>::empty();
  PackedBox<T> centers = PackedBox<T>::empty();
  bool in_scratch = false;  ///< the references lie in the second of a builder's two arrays

  GLINT_ALWAYS_INLINE void extend(const Reference<T>& reference) noexcept {
    box.extend(reference.lower, reference.upper);
    const Pack<T, 4> center = reference.center();
    centers.extend(center, center);
  }
  void extend(const Part& other) noexcept {
    box.extend(other.box);
    centers.extend(other.centers);
  }
  [[nodiscard]] int longest_axis() const noexcept {
    const Pack<T, 4> e = centers.upper - centers.lower;
    return max_axis(Vec3<T>{e[0], e[1], e[2]});
  }
};

/// Work of the size of a whole set is cut into runs of this many references, whatever the executor, so that no result
/// depends on it.
inline constexpr std::size_t chunk_size = std::size_t{1} << 14;

[[nodiscard]] constexpr std::size_t chunks(std::size_t n) noexcept {
  return (n + chunk_size - 1) / chunk_size;
}

/// Calls `body(chunk, begin, end)` for each chunk of [0, n).
template <typename Executor, typename Body>
void for_each_chunk(std::size_t n, const Executor& executor, const Body& body) {
  executor.parallel_for(chunks(n), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c != end; ++c) body(c, c * chunk_size, std::min(n, (c + 1) * chunk_size));
  });
}

/// What n primitives of a leaf cost, in tests. Requires: block_size ≥ 1.
[[nodiscard]] constexpr std::size_t blocks(std::size_t n, std::size_t block_size) noexcept {
  return (n + block_size - 1) / block_size;
}

/// References to those primitives of a set that have finite, non-empty boxes, in the order of the set.
///
/// Requires: set.size() fits the index type, and 32 bits where the scalar is `float`.
template <BoundedSet S, typename Executor>
[[nodiscard]] References<typename S::Scalar> gather(const S& set, const Executor& executor) {
  using T = typename S::Scalar;
  using I = typename S::Index;
  GLINT_ASSERT(set.size() <= std::numeric_limits<I>::max());
  GLINT_ASSERT(set.size() <= std::numeric_limits<typename Reference<T>::Bits>::max());
  References<T> references(set.size());
  std::vector<std::size_t> kept(chunks(references.size()));
  for_each_chunk(references.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::size_t next = begin;
    for (std::size_t i = begin; i != end; ++i) {
      const Aabb<T> box = set.bounds(I(i));
      if (is_bounded(box)) references[next++] = Reference<T>(box, i);
    }
    kept[chunk] = next - begin;
  });
  auto out = references.begin();
  for (std::size_t chunk = 0; chunk != kept.size(); ++chunk) {
    const auto begin = references.begin() + std::ptrdiff_t(chunk * chunk_size);
    out = begin == out ? out + std::ptrdiff_t(kept[chunk]) : std::copy_n(begin, kept[chunk], out);
  }
  references.erase(out, references.end());
  return references;
}

/// All references as one part.
template <std::floating_point T, typename Executor>
[[nodiscard]] Part<T> whole(std::span<const Reference<T>> references, const Executor& executor) {
  std::vector<Part<T>> partial(chunks(references.size()));
  for_each_chunk(references.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    Part<T> part;  // local: in a register, and no cache line shared by threads
    for (std::size_t i = begin; i != end; ++i) part.extend(references[i]);
    partial[chunk] = part;
  });
  Part<T> all{.count = references.size()};
  for (const Part<T>& part : partial) all.extend(part);
  return all;
}

/// A part over the run [first, first + references.size()).
template <std::floating_point T>
[[nodiscard]] Part<T> measured(std::span<const Reference<T>> references, std::size_t first, bool in_scratch) noexcept {
  Part<T> part{.first = first, .count = references.size(), .in_scratch = in_scratch};
  for (const Reference<T>& reference : references) part.extend(reference);
  return part;
}

/// Two halves of equal counts by the centers along the longest axis; equal centers by index, so that the halves do not
/// depend on the order of the references.
template <std::floating_point T>
[[nodiscard]] std::pair<Part<T>, Part<T>> halve(std::span<Reference<T>> references, const Part<T>& part) {
  const int axis = part.longest_axis();
  const auto middle = references.begin() + std::ptrdiff_t(references.size() / 2);
  std::nth_element(references.begin(), middle, references.end(), [axis](const auto& a, const auto& b) {
    const T ca = a.center(axis);
    const T cb = b.center(axis);
    return ca < cb || (ca == cb && a.index() < b.index());
  });
  const std::size_t half = references.size() / 2;
  return {measured<T>(references.first(half), part.first, part.in_scratch),
          measured<T>(references.subspan(half), part.first + half, part.in_scratch)};
}

}  // namespace glint::detail

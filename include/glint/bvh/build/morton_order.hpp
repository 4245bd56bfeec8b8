// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glint/bvh/build/radix_sort.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/core/config.hpp>
#include <glint/simd/pack.hpp>

namespace glint::detail {

/// The 21 lowest bits, two zeros between each and the next.
[[nodiscard]] constexpr std::uint64_t spread_by_three(std::uint64_t x) noexcept {
  x &= 0x1FFFFF;
  x = (x | x << 32) & 0x001F00000000FFFF;
  x = (x | x << 16) & 0x001F0000FF0000FF;
  x = (x | x << 8) & 0x100F00F00F00F00F;
  x = (x | x << 4) & 0x10C30C30C30C30C3;
  x = (x | x << 2) & 0x1249249249249249;
  return x;
}

/// References in the order of a curve through their centers, which keeps neighbors in space near each other.
///
/// A key is a Morton code in its high bits, and below it the place of the reference. So no two keys are equal, and the
/// code has all the bits that the places leave. Cells are cubes: what is flat is not cut as often across as along.
template <std::floating_point T>
struct MortonOrder {
  int place_bits = 0;
  Keys keys;

  /// Requires: references in the box; at least one.
  template <typename Executor>
  MortonOrder(std::span<const Reference<T>> references, const PackedBox<T>& centers, const Executor& executor)
      : place_bits(int(std::bit_width(references.size() - 1))), keys(references.size()) {
    const int axis_bits = std::min(21, (64 - place_bits) / 3);
    const T cells = T(std::int32_t{1} << axis_bits);
    const Pack<T, 4> e = centers.upper - centers.lower;
    const T scale = cells / std::max(std::max(e[0], e[1]), e[2]);
    const auto scales = Pack<T, 4>::broadcast(scale <= std::numeric_limits<T>::max() ? scale : T(0));
    const auto last = Pack<T, 4>::broadcast(cells - T(1));
    for_each_chunk(keys.size(), executor, [&](std::size_t /*chunk*/, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const auto cell = truncated(min((references[i].center() - centers.lower) * scales, last));
        const std::uint64_t code = spread_by_three(std::uint64_t(cell[0])) << 2 |
                                   spread_by_three(std::uint64_t(cell[1])) << 1 |
                                   spread_by_three(std::uint64_t(cell[2]));
        keys[i] = code << place_bits | i;
      }
    });
    radix_sort(keys, place_bits, executor);
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE std::size_t place(std::size_t i) const noexcept {
    return std::size_t(keys[i] & ((std::uint64_t{1} << place_bits) - 1));
  }
  /// Where the first bit changes in which keys of the run [begin, end) differ: begin < it < end.
  ///
  /// Requires: two keys at least.
  [[nodiscard]] std::size_t split(std::size_t begin, std::size_t end) const noexcept {
    const std::uint64_t bit = std::bit_floor(keys[begin] ^ keys[end - 1]);
    const auto first = keys.begin() + std::ptrdiff_t(begin);
    const auto last = keys.begin() + std::ptrdiff_t(end);
    return std::size_t(std::partition_point(first, last, [bit](std::uint64_t key) { return (key & bit) == 0; }) -
                       keys.begin());
  }
};

}  // namespace glint::detail

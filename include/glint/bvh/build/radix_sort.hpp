// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/core/uninitialized.hpp>

namespace glint::detail {

using Keys = UninitializedVector<std::uint64_t>;

/// A number for each value of a byte, in each chunk of the keys.
using PerByte = std::array<std::size_t, 256>;

[[nodiscard]] constexpr std::size_t byte_at(std::uint64_t key, int shift) noexcept {
  return std::size_t((key >> shift) & 0xFF);
}

/// How often each byte occurs in each chunk.
template <typename Executor>
void count_bytes(const Keys& keys, int shift, std::vector<PerByte>& counts, const Executor& executor) {
  for_each_chunk(keys.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    PerByte count{};  // local: no cache line shared by threads
    for (std::size_t i = begin; i != end; ++i) ++count[byte_at(keys[i], shift)];
    counts[chunk] = count;
  });
}

/// Makes of each count the place where the keys counted begin: by bytes, then by chunks. False if all bytes are equal.
[[nodiscard]] inline bool make_places(std::vector<PerByte>& counts, std::size_t total) noexcept {
  std::size_t place = 0;
  bool differ = true;
  for (std::size_t byte = 0; byte != 256; ++byte) {
    const std::size_t first = place;
    for (PerByte& count : counts) {
      const std::size_t n = count[byte];
      count[byte] = place;
      place += n;
    }
    differ = differ && place - first != total;
  }
  return differ;
}

/// Puts each key in its place.
template <typename Executor>
void deal_bytes(const Keys& keys, int shift, const std::vector<PerByte>& places, Keys& sorted,
                const Executor& executor) {
  for_each_chunk(keys.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    PerByte place = places[chunk];
    for (std::size_t i = begin; i != end; ++i) sorted[place[byte_at(keys[i], shift)]++] = keys[i];
  });
}

/// Sorts keys by their bits from `begin_bit` up; equal ones keep their order. One byte at a time from the lowest, and
/// bytes in which all keys agree cost no move.
///
/// Requires: begin_bit in 0 … 63.
/// Cost:     O(n) a byte; as much memory again as the keys.
/// Threads:  counts and moves by chunks; the order is unique, so it depends on no executor.
template <typename Executor>
void radix_sort(Keys& keys, int begin_bit, const Executor& executor) {
  Keys sorted(keys.size());
  std::vector<PerByte> places(chunks(keys.size()));
  for (int shift = begin_bit; shift < 64; shift += 8) {
    count_bytes(keys, shift, places, executor);
    if (!make_places(places, keys.size())) continue;
    deal_bytes(keys, shift, places, sorted, executor);
    keys.swap(sorted);
  }
}

}  // namespace glint::detail

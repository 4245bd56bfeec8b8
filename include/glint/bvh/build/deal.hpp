// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glint/bvh/build/binning.hpp>
#include <glint/bvh/build/reference.hpp>
#include <glint/core/config.hpp>

namespace glint::detail {

/// Where a reference goes: a bit a side.
enum class Side : std::uint8_t { Left = 1, Right = 2, Both = 3 };

/// Deals references out to two sides, in their order.
///
///     Side side(const Reference&)
///     bool cuts                                              // whether the answer may be Both, and then
///     std::pair<Reference, Reference> cut(const Reference&)  // what goes to either side
template <std::floating_point T>
struct Dealt {
  Reference<T>* left_end = nullptr;
  Reference<T>* right_end = nullptr;
  Part<T> left{};
  Part<T> right{};

  /// Where the i-th goes, `side_of(i)` says.
  template <typename SideOf, typename Dealer>
  GLINT_ALWAYS_INLINE void add(std::span<const Reference<T>> references, const SideOf& side_of, const Dealer& dealer) {
    Dealt dealt = *this;  // local: in registers
    for (std::size_t i = 0; i != references.size(); ++i) dealt.add(references[i], side_of(i), dealer);
    *this = dealt;
  }

 private:
  template <typename Dealer>
  GLINT_ALWAYS_INLINE void add(const Reference<T>& r, Side side, const Dealer& dealer) {
    if (side == Side::Left) return add_left(r);
    if constexpr (Dealer::cuts) {
      if (side == Side::Both) {
        const std::pair<Reference<T>, Reference<T>> halves = dealer.cut(r);
        add_left(halves.first);
        return add_right(halves.second);
      }
    }
    add_right(r);
  }
  GLINT_ALWAYS_INLINE void add_left(const Reference<T>& r) noexcept {
    left.extend(r);
    *left_end++ = r;
  }
  GLINT_ALWAYS_INLINE void add_right(const Reference<T>& r) noexcept {
    right.extend(r);
    *right_end++ = r;
  }
};

/// Many references, by chunks: counted first, so that each chunk knows its places.
template <std::floating_point T, typename Dealer, typename Executor>
void deal_chunks(Dealt<T>& all, std::span<const Reference<T>> from, const Dealer& dealer, const Executor& executor) {
  std::vector<Dealt<T>> dealt(chunks(from.size()));
  std::vector<Side> sides(from.size());
  for_each_chunk(from.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    std::size_t left = 0;
    std::size_t right = 0;
    for (std::size_t i = begin; i != end; ++i) {
      sides[i] = dealer.side(from[i]);
      left += unsigned(sides[i]) & 1U;
      right += unsigned(sides[i]) >> 1U;
    }
    dealt[chunk].left.count = left;
    dealt[chunk].right.count = right;
  });
  for (Dealt<T>& d : dealt) {
    d.left_end = std::exchange(all.left_end, all.left_end + d.left.count);
    d.right_end = std::exchange(all.right_end, all.right_end + d.right.count);
  }
  for_each_chunk(from.size(), executor, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    const auto side_of = [&](std::size_t i) { return sides[begin + i]; };
    dealt[chunk].add(from.subspan(begin, end - begin), side_of, dealer);
  });
  for (const Dealt<T>& d : dealt) {
    all.left.extend(d.left);
    all.right.extend(d.right);
  }
}

/// Two parts for one, in the other of a builder's two arrays. `from` are the references of the part, `to` its slots
/// there, with those to spare. The slots up to `right_begin` are the left side's, the others the right side's; what
/// they do not need is theirs to spare.
template <std::floating_point T, typename Dealer, typename Executor>
[[nodiscard]] std::pair<Part<T>, Part<T>> deal(const Part<T>& part, std::size_t right_begin, const Dealer& dealer,
                                               std::span<const Reference<T>> from, std::span<Reference<T>> to,
                                               const Executor& executor) {
  Dealt<T> dealt{.left_end = to.data(), .right_end = to.data() + right_begin};
  if (part.count > parallel_size)
    deal_chunks(dealt, from, dealer, executor);
  else
    dealt.add(
        from, [&](std::size_t i) { return dealer.side(from[i]); }, dealer);
  auto& [left_end, right_end, left, right] = dealt;
  left.first = part.first;
  left.count = std::size_t(left_end - to.data());
  left.spare = right_begin - left.count;
  right.first = part.first + right_begin;
  right.count = std::size_t(right_end - to.data()) - right_begin;
  right.spare = to.size() - right_begin - right.count;
  left.in_scratch = right.in_scratch = !part.in_scratch;
  return {left, right};
}

/// Deals by the bin of the center.
template <std::floating_point T>
struct CenterDealer {
  static constexpr bool cuts = false;
  const Binning<T>& binning;
  BinPlane<T> plane;

  [[nodiscard]] GLINT_ALWAYS_INLINE Side side(const Reference<T>& r) const noexcept {
    return binning(r)[plane.axis] < plane.right ? Side::Left : Side::Right;
  }
};

}  // namespace glint::detail

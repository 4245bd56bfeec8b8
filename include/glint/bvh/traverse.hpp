// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

template <std::floating_point T, std::unsigned_integral I>
struct Pending {
  Link<I> link;
  T key;
};

/// The links still to be followed. A walk leaves at most width − 1 siblings behind at each of max_depth levels, and
/// takes the last child without storing it, so this is never full: descend() stores `width` for a moment, at the
/// deepest level, hence the one more.
template <Layout L>
using PendingOf = FixedStack<Pending<typename L::Scalar, typename L::Index>,
                             std::size_t(Tree<typename L::Scalar, typename L::Index>::max_depth*(L::width - 1) + 1)>;

/// Puts a child on the run of its siblings that begins at `base`, which is kept sorted: the smallest key on top.
template <typename Stack, typename Entry>
GLINT_ALWAYS_INLINE void push_sorted(Stack& pending, std::size_t base, const Entry& entry) noexcept {
  std::size_t at = pending.size();
  pending.push(entry);
  for (; at > base && pending[at - 1].key < entry.key; --at) pending[at] = pending[at - 1];
  pending[at] = entry;
}

/// From an inner node to the child to visit first; its siblings are left on the stack. False where no child matters.
template <Layout L, typename Query>
[[nodiscard]] GLINT_ALWAYS_INLINE bool descend(const L& layout, const Query& query, Link<typename L::Index>& link,
                                               PendingOf<L>& pending) noexcept {
  using T = typename L::Scalar;
  const auto& boxes = layout.children(link.first);
  const auto& links = layout.links(link.first);
  const Entered<T, L::width> entered = query.enter(boxes);
  std::uint32_t mask = entered.mask;
  if (mask == 0) return false;
  const auto next = [&] {
    const int i = std::countr_zero(mask);
    mask &= mask - 1;
    return i;
  };
  const int first = next();
  if (mask == 0) {
    link = links[std::size_t(first)];
    return true;
  }
  std::array<T, std::size_t(L::width)> key;
  entered.key.store(key.data());
  const auto child = [&](int i) { return Pending<T, typename L::Index>{links[std::size_t(i)], key[std::size_t(i)]}; };
  if constexpr (Query::ordered) {
    const int second = next();
    if (mask == 0) {
      const bool swapped = key[std::size_t(second)] < key[std::size_t(first)];
      pending.push(child(swapped ? first : second));
      link = links[std::size_t(swapped ? second : first)];
      return true;
    }
    const std::size_t base = pending.size();
    pending.push(child(first));
    push_sorted(pending, base, child(second));
    while (mask != 0) push_sorted(pending, base, child(next()));
    link = pending.pop().link;
  } else {
    link = links[std::size_t(first)];
    while (mask != 0) pending.push(child(next()));
  }
  return true;
}

}  // namespace detail

/// Walks a tree as a query wants it, and shows the leaves that may matter to `visit(Slots) -> Walk`, which may improve
/// the query meanwhile. Ray casts, and every other question, are this loop.
///
/// Ensures: Walk::Stop if a visit said so, which ends the walk; else Walk::Continue.
/// Cost:    no allocation.
template <Layout L, QueryFor<typename L::Scalar, L::width> Query, typename Visit>
GLINT_ALWAYS_INLINE Walk traverse(const L& layout, const Query& query, const Visit& visit) {
  if (layout.empty()) return Walk::Continue;
  detail::PendingOf<L> pending;
  Link<typename L::Index> link = layout.root();
  while (true) {
    bool matters = true;
    while (matters && !link.is_leaf()) matters = detail::descend(layout, query, link, pending);
    if (matters && visit(link.slots()) == Walk::Stop) return Walk::Stop;
    bool found = false;
    while (!found) {
      if (pending.empty()) return Walk::Continue;
      const auto next = pending.pop();
      link = next.link;
      found = !Query::ordered || next.key <= query.limit();
    }
  }
}

}  // namespace glint

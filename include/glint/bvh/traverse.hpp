// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/config.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/simd/pack.hpp>

namespace glint {
namespace detail {

/// What a visitor says, where one that returns nothing wants to go on.
template <typename Visit, typename... Args>
GLINT_ALWAYS_INLINE Walk visited(const Visit& visit, const Args&... args) {
  if constexpr (std::same_as<std::invoke_result_t<const Visit&, const Args&...>, void>) {
    visit(args...);
    return Walk::Continue;
  } else {
    return visit(args...);
  }
}

template <std::floating_point T, std::unsigned_integral I>
struct Pending {
  Link<I> link;
  T key;
};

/// The links still to be followed. A walk leaves at most width − 1 siblings behind at each of max_depth levels, and
/// takes the nearest child without leaving it, so this is never full: descend() stores `width` for a moment, at the
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

/// Where the bits of a mask are, from the lowest.
[[nodiscard]] GLINT_ALWAYS_INLINE std::size_t take_lowest(std::uint32_t& mask) noexcept {
  const auto i = std::size_t(std::countr_zero(mask));
  mask &= mask - 1;
  return i;
}

/// Leaves the children of the mask but the nearest of all on the stack, and returns that.
///
/// The commonest case, two of them, is decided by a branch: what is guessed need not be waited for.
template <Layout L, typename Links>
[[nodiscard]] GLINT_ALWAYS_INLINE Link<typename L::Index> nearest_of(const Links& links,
                                                                     const Pack<typename L::Scalar, L::width>& keys,
                                                                     std::size_t first, std::uint32_t mask,
                                                                     PendingOf<L>& pending) noexcept {
  using Entry = Pending<typename L::Scalar, typename L::Index>;
  std::array<typename L::Scalar, std::size_t(L::width)> key;
  keys.store(key.data());
  const std::size_t second = take_lowest(mask);
  const Entry a{links[first], key[first]};
  const Entry b{links[second], key[second]};
  if (mask == 0) {
    if (a.key <= b.key) {
      pending.push(b);
      return a.link;
    }
    pending.push(a);
    return b.link;
  }
  const std::size_t base = pending.size();
  pending.push(a.key < b.key ? b : a);
  pending.push(a.key < b.key ? a : b);
  do {
    const std::size_t i = take_lowest(mask);
    push_sorted(pending, base, Entry{links[i], key[i]});
  } while (mask != 0);
  return pending.pop().link;
}

/// From an inner node to the child to visit first; its siblings are left on the stack. False where no child matters.
template <Layout L, typename Query>
[[nodiscard]] GLINT_ALWAYS_INLINE bool descend(const L& layout, const Query& query, Link<typename L::Index>& link,
                                               PendingOf<L>& pending) noexcept {
  const auto& links = layout.links(link.first);
  const Entered<typename L::Scalar, L::width> entered = query.enter(layout.children(link.first));
  std::uint32_t mask = entered.mask;
  if (mask == 0) return false;
  const std::size_t first = take_lowest(mask);
  link = links[first];
  if (mask == 0) return true;
  if constexpr (Query::ordered) {
    link = nearest_of<L>(links, entered.key, first, mask, pending);
  } else {
    do {
      pending.push({links[take_lowest(mask)], {}});
    } while (mask != 0);
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
    if (!link.is_leaf()) {
      if (detail::descend(layout, query, link, pending)) continue;
    } else if (visit(link.slots()) == Walk::Stop) {
      return Walk::Stop;
    }
    do {
      if (pending.empty()) return Walk::Continue;
      const auto next = pending.pop();
      link = next.link;
      if (!Query::ordered || next.key <= query.limit()) break;
    } while (true);
  }
}

}  // namespace glint

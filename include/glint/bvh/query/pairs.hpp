// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/leaf_pairs.hpp>
#include <glint/bvh/query/region.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {
namespace detail {

/// A node or leaf of one tree and one of another, whose boxes overlap.
template <std::floating_point T, std::unsigned_integral I, std::unsigned_integral J>
struct LinkPair {
  Link<I> a;
  Link<J> b;
  Aabb<T> box_a;
  Aabb<T> box_b;
  bool is_self = false;  ///< `a` with itself: each pair of what is in it once
};

/// Goes down two trees at once, or one against itself, and shows leaves to `leaves` where their boxes overlap.
template <Layout A, Layout B>
class PairWalk {
 public:
  using T = typename A::Scalar;
  using Both = LinkPair<T, typename A::Index, typename B::Index>;

  PairWalk(const A& a, const B& b) noexcept : a_(a), b_(b) {}

  /// To both children of nodes, or to those of the one that is no leaf. Requires: not two leaves.
  template <typename Emit>
  Walk expand(const Both& both, const Emit& emit) const {
    if (both.is_self) return expand_self(both, emit);
    if (both.a.is_leaf())
      return for_each_child(b_, both.b, both.box_a, [&](Link<typename B::Index> child, const Aabb<T>& box) {
        return emit({both.a, child, both.box_a, box});
      });
    if (both.b.is_leaf())
      return for_each_child(a_, both.a, both.box_b, [&](Link<typename A::Index> child, const Aabb<T>& box) {
        return emit({child, both.b, box, both.box_b});
      });
    const BoxPack<T, A::width>& boxes = a_.children(both.a.first);
    const auto& links = a_.links(both.a.first);
    std::uint32_t mask = RegionQuery<Aabb<T>, T, A::width>(both.box_b).enter(boxes).overlapping & lanes_of_boxes(boxes);
    while (mask != 0) {
      const std::size_t i = take_lowest(mask);
      const Aabb<T> box_a = box_in_lane(boxes, int(i));
      const Walk walk = for_each_child(b_, both.b, box_a, [&](Link<typename B::Index> child, const Aabb<T>& box) {
        return emit({links[i], child, box_a, box});
      });
      if (walk == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }

  template <typename Leaves>
  Walk run(const Both& both, const Leaves& leaves) const {
    if (both.a.is_leaf() && both.b.is_leaf()) return leaves(both);
    return expand(both, [&](const Both& next) { return run(next, leaves); });
  }

 private:
  template <typename L, typename F>
  GLINT_ALWAYS_INLINE static Walk for_each_child(const L& layout, const Link<typename L::Index>& link,
                                                 const Aabb<T>& region, const F& f) {
    const BoxPack<T, L::width>& boxes = layout.children(link.first);
    const auto& links = layout.links(link.first);
    std::uint32_t mask = RegionQuery<Aabb<T>, T, L::width>(region).enter(boxes).overlapping & lanes_of_boxes(boxes);
    while (mask != 0) {
      const std::size_t i = take_lowest(mask);
      if (f(links[i], box_in_lane(boxes, int(i))) == Walk::Stop) return Walk::Stop;
    }
    return Walk::Continue;
  }
  template <typename Emit>
  Walk expand_self(const Both& both, const Emit& emit) const {
    const BoxPack<T, A::width>& boxes = a_.children(both.a.first);
    const auto& links = a_.links(both.a.first);
    const std::uint32_t present = lanes_of_boxes(boxes);
    for (std::uint32_t rest = present; rest != 0;) {
      const std::size_t i = take_lowest(rest);
      const Aabb<T> box = box_in_lane(boxes, int(i));
      if (emit({links[i], links[i], box, box, true}) == Walk::Stop) return Walk::Stop;
      std::uint32_t mask = RegionQuery<Aabb<T>, T, A::width>(box).enter(boxes).overlapping & rest;
      while (mask != 0) {
        const std::size_t j = take_lowest(mask);
        if (emit({links[i], links[j], box, box_in_lane(boxes, int(j))}) == Walk::Stop) return Walk::Stop;
      }
    }
    return Walk::Continue;
  }

  const A& a_;
  const B& b_;
};

/// A few hundred pairs of nodes that may be looked at one by one; the same for every executor.
template <typename Pairs, typename Both>
[[nodiscard]] std::vector<Both> spread(const Pairs& pairs, const Both& root) {
  constexpr std::size_t enough = 256;
  std::vector<Both> tasks{root};
  for (int round = 0; round < 4 && tasks.size() < enough; ++round) {
    std::vector<Both> next;
    const auto add = [&](const Both& both) {
      next.push_back(both);
      return Walk::Continue;
    };
    for (const Both& task : tasks) {
      if (task.a.is_leaf() && task.b.is_leaf())
        add(task);
      else
        pairs.expand(task, add);
    }
    tasks = std::move(next);
  }
  return tasks;
}

/// Two trees, of which one may be the other.
template <PrimitiveSet S, LayoutChoice L, PrimitiveSet R, LayoutChoice M>
class TreePair {
 public:
  using Walker = PairWalk<typename Bvh<S, L>::Nodes, typename Bvh<R, M>::Nodes>;
  using Both = typename Walker::Both;
  using IndexPair = std::pair<typename S::Index, typename R::Index>;

  TreePair(const Bvh<S, L>& a, const Bvh<R, M>& b, bool is_self) noexcept
      : a_(a), b_(b), is_self_(is_self), walk_(a.nodes(), b.nodes()) {}

  /// Shows pairs to `visit(i, j)`; where trees have primitives in parts, some more than once.
  template <typename Visit>
  Walk for_each(const Visit& visit) const {
    if (!may_overlap()) return Walk::Continue;
    return run(root(), visit);
  }
  template <Executor E>
  [[nodiscard]] std::vector<IndexPair> all(const E& executor) const {
    if (!may_overlap()) return {};
    const std::vector<Both> tasks = spread(walk_, root());
    std::vector<std::vector<IndexPair>> found(tasks.size());
    executor.parallel_for(tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i)
        run(tasks[i], [&](auto a, auto b) {
          found[i].emplace_back(a, b);
          return Walk::Continue;
        });
    });
    std::vector<IndexPair> pairs;
    for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
  }

 private:
  [[nodiscard]] bool may_overlap() const {
    return !a_.nodes().empty() && !b_.nodes().empty() && overlaps(a_.bounds(), b_.bounds());
  }
  [[nodiscard]] Both root() const { return {a_.nodes().root(), b_.nodes().root(), a_.bounds(), b_.bounds(), is_self_}; }
  template <typename Visit>
  Walk run(const Both& both, const Visit& visit) const {
    const LeafPairs<S, typename Bvh<S, L>::Leaves, R, typename Bvh<R, M>::Leaves, Visit> leaves(
        a_.set(), a_.leaves(), b_.set(), b_.leaves(), visit, is_self_);
    return walk_.run(both, [&](const Both& at) {
      if constexpr (std::same_as<Bvh<S, L>, Bvh<R, M>>) {
        if (at.is_self) return leaves.within(at.a.slots());
      }
      return leaves.between(at.a.slots(), at.b.slots());
    });
  }

  const Bvh<S, L>& a_;
  const Bvh<R, M>& b_;
  bool is_self_;
  Walker walk_;
};

template <typename Pairs, typename Visit>
Walk for_each_pair_once(const Pairs& pairs, bool has_parts, const Visit& visit) {
  std::set<typename Pairs::IndexPair> seen;
  return pairs.for_each(
      [&](auto i, auto j) { return has_parts && !seen.emplace(i, j).second ? Walk::Continue : visited(visit, i, j); });
}

}  // namespace detail

/// Shows the pairs of primitives of two trees that overlap to `visit(Index of a, Index of b)`, in no order. It may
/// return a Walk: Stop ends the search.
///
/// Triangles are tested exactly; of other primitives `overlaps(p, q)` decides, where there is one, else each is tested
/// with the box of the other.
///
/// Ensures: each pair once. Walk::Stop if a visit said so.
/// Errors:  triangles without area or with a NaN overlap none.
/// Cost:    no allocation, unless a tree has primitives in parts: then a set of the pairs seen.
/// Threads: may be called by many at once.
template <PrimitiveSet S, LayoutChoice L, PrimitiveSet R, LayoutChoice M, typename Visit>
  requires std::same_as<typename S::Scalar, typename R::Scalar> Walk for_each_overlapping_pair(const Bvh<S, L>& a,
                                                                                               const Bvh<R, M>& b,
                                                                                               const Visit& visit) {
    return detail::for_each_pair_once(detail::TreePair<S, L, R, M>(a, b, false), a.has_parts() || b.has_parts(), visit);
  }

/// The same pairs, sorted.
///
/// Threads: parts of the trees in parallel; the same for every executor.
template <PrimitiveSet S, LayoutChoice L, PrimitiveSet R, LayoutChoice M, Executor E = Serial>
  requires std::same_as<typename S::Scalar, typename R::Scalar>
[[nodiscard]] std::vector<std::pair<typename S::Index, typename R::Index>> overlapping_pairs(const Bvh<S, L>& a,
                                                                                             const Bvh<R, M>& b,
                                                                                             const E& executor = {}) {
  return detail::TreePair<S, L, R, M>(a, b, false).all(executor);
}

/// Whether any primitive of one tree overlaps one of the other.
template <PrimitiveSet S, LayoutChoice L, PrimitiveSet R, LayoutChoice M>
  requires std::same_as<typename S::Scalar, typename R::Scalar>
[[nodiscard]] bool overlaps(const Bvh<S, L>& a, const Bvh<R, M>& b) {
  return detail::TreePair<S, L, R, M>(a, b, false).for_each([](auto, auto) { return Walk::Stop; }) == Walk::Stop;
}

/// Shows the pairs of a tree's own primitives that overlap to `visit(i, j)`, i < j, in no order. It may return a Walk.
/// Triangles that share a corner or an edge count where they have more than that in common: overlaps_beyond_corners.
///
/// Ensures, Errors, Cost, Threads: as for_each_overlapping_pair.
template <PrimitiveSet S, LayoutChoice L, typename Visit>
Walk for_each_self_overlap(const Bvh<S, L>& bvh, const Visit& visit) {
  return detail::for_each_pair_once(detail::TreePair<S, L, S, L>(bvh, bvh, true), bvh.has_parts(), visit);
}

/// The same pairs, sorted: where a mesh runs into itself.
///
/// Threads: parts of the tree in parallel; the same for every executor.
template <PrimitiveSet S, LayoutChoice L, Executor E = Serial>
[[nodiscard]] std::vector<std::pair<typename S::Index, typename S::Index>> self_overlaps(const Bvh<S, L>& bvh,
                                                                                         const E& executor = {}) {
  return detail::TreePair<S, L, S, L>(bvh, bvh, true).all(executor);
}

}  // namespace glint

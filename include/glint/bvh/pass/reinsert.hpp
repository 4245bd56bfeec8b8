// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glint/bvh/build/reference.hpp>
#include <glint/bvh/pass/depth_first.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/fixed_stack.hpp>

namespace glint {

/// How long to look for better places. The defaults take a tenth off the cost of halls and forests and next to nothing
/// off a scanned statue, whose first tree is as good, for about the time that BinnedSah takes.
struct Reinsertion {
  float batch = 0.1F;  ///< the share of the nodes that are tried in a round, the most wasteful ones
  int rounds = 10;
  float least_gain = 0.003F;  ///< a round that takes no more than this share off the cost is the last
};

namespace detail {

/// A tree in the making. Node 1 is the root, siblings lie at 2k and 2k + 1, so a sibling is found without a link.
template <std::floating_point T, std::unsigned_integral I>
class Reinserter {
 public:
  /// A node to be moved, and the node whose sibling it is to become.
  struct Move {
    I node = 0;
    I to = 0;
    T gain = 0;  ///< in area of inner nodes
  };

  /// Requires: a tree numbered depth first.
  explicit Reinserter(const Tree<T, I>& tree)
      : boxes_(tree.nodes.size() + 1),
        links_(tree.nodes.size() + 1),
        heights_(tree.nodes.size() + 1),
        parents_(tree.nodes.size() / 2 + 1) {
    for (std::size_t i = tree.nodes.size(); i > 0; --i) {
      const BinaryNode<T, I>& node = tree.nodes[i - 1];
      links_[i] = {node.is_leaf() ? node.first : I(node.first + 1), node.count};
      if (node.is_leaf()) {
        const Reference<T> box(node.bounds, 0);
        boxes_[i] = {box.lower, box.upper};
      } else {
        adopt_children(I(i));
        fit(I(i));
      }
    }
  }

  /// The areas of the inner nodes: all of the cost that moves can change.
  [[nodiscard]] double cost() const noexcept {
    double sum = 0;
    for (std::size_t i = root; i < size(); ++i) sum += is_inner(I(i)) ? double(area(I(i))) : 0;
    return sum;
  }

  /// Of the nodes but the root, the given share that promises most: large parents, of which the node fills little.
  [[nodiscard]] std::vector<I> most_wasteful(float share) const {
    std::vector<std::pair<T, I>> keys;
    keys.reserve(size());
    for (std::size_t i = root + 1; i < size(); ++i) keys.emplace_back(-waste(I(i)), I(i));
    const auto n = std::ptrdiff_t(std::ceil(double(std::clamp(share, 0.0F, 1.0F)) * double(keys.size())));
    std::nth_element(keys.begin(), keys.begin() + n, keys.end());
    keys.resize(std::size_t(n));
    std::vector<I> nodes(keys.size());
    std::transform(keys.begin(), keys.end(), nodes.begin(), [](const auto& key) { return key.second; });
    return nodes;
  }

  /// The best place for a node, by the tree as it is.
  [[nodiscard]] Move best_move(I node) const noexcept {
    Move best{.node = node};
    I at = parent(node);
    PackedBox<T> rest = boxes_[sibling(node)];  // of `at`, were the node taken out
    T freed = area(at);
    search(sibling(node), freed, best);
    while (at != root) {
      search(sibling(at), freed, best);
      rest.extend(boxes_[sibling(at)]);
      at = parent(at);
      freed += area(at) - rest.half_area();
      if (const T gain = freed - area(at); gain > best.gain) best = {node, at, gain};
    }
    return best;
  }

  /// Moves the node if that still is a gain in the tree as it is now, which it returns; else does nothing.
  T apply(const Move& move) noexcept {
    const T now = gain(move.node, move.to);
    if (!(now > T(0))) return 0;
    const I hole = sibling(move.node);
    const I at = parent(move.node);
    transfer(hole, at);
    fit_above(at);
    transfer(move.to, hole);
    links_[move.to] = {move.node & ~I(1), 0};
    adopt_children(move.to);
    fit(move.to);
    fit_above(move.to);
    return now;
  }

  [[nodiscard]] Tree<T, I> tree(std::vector<I> order) const {
    Tree<T, I> result{.order = std::move(order)};
    result.nodes.reserve(size() - root);
    for (std::size_t i = root; i < size(); ++i) {
      const Link link = links_[i];
      result.nodes.push_back({boxes_[i].box(), is_inner(I(i)) ? link.first - I(1) : link.first, link.count});
    }
    return result;
  }

 private:
  static constexpr I root = 1;
  static constexpr std::size_t max_depth = std::size_t(Tree<T, I>::max_depth);

  struct Link {
    I first = 0;  ///< of the children, or of the slots
    I count = 0;
  };
  /// From the root to a node, both included.
  struct Path {
    std::array<I, max_depth + 1> node;
    std::size_t size = 0;
  };
  /// A node to look below of, and the gain that is left for a place there, before the new node's area is taken off.
  struct Candidate {
    I node;
    T left;
  };

  [[nodiscard]] std::size_t size() const noexcept { return boxes_.size(); }
  [[nodiscard]] T area(I node) const noexcept { return boxes_[node].half_area(); }
  [[nodiscard]] bool is_inner(I node) const noexcept { return links_[node].count == 0; }
  [[nodiscard]] static constexpr I sibling(I node) noexcept { return node ^ I(1); }
  [[nodiscard]] I parent(I node) const noexcept { return parents_[node / 2]; }

  /// Never NaN.
  [[nodiscard]] T waste(I node) const noexcept {
    const T all = area(parent(node));
    const T own = area(node);
    return all > 0 ? all / ((own < all ? own / all : T(1)) + T(0.001)) : T(0);
  }

  /// Tries to become the sibling of `top` or of a node below it, which frees `freed` before the cost of the new place.
  void search(I top, T freed, Move& best) const noexcept {
    const PackedBox<T> box = boxes_[best.node];
    const T least = box.half_area();  // the new node holds the node
    FixedStack<Candidate, max_depth + 2> pending;
    const auto consider = [&](I node, T left) {
      PackedBox<T> both = box;
      both.extend(boxes_[node]);
      const T gain = left - both.half_area();
      if (gain > best.gain) {
        best.gain = gain;
        best.to = node;
      }
      return Candidate{node, gain + area(node)};
    };
    const auto add = [&](const Candidate& candidate) {
      if (is_inner(candidate.node) && candidate.left - least > best.gain) pending.push(candidate);
    };
    if (!(freed - least > best.gain)) return;
    add(consider(top, freed));
    while (!pending.empty()) {
      const Candidate next = pending.pop();
      if (!(next.left - least > best.gain)) continue;
      const I first = links_[next.node].first;
      const Candidate a = consider(first, next.left);
      const Candidate b = consider(first + 1, next.left);
      add(a.left < b.left ? a : b);
      add(a.left < b.left ? b : a);
    }
  }

  [[nodiscard]] Path path_to(I node) const noexcept {
    Path path;
    for (I at = node;; at = parent(at)) {
      path.node[path.size++] = at;
      if (at == root) break;
    }
    std::reverse(path.node.begin(), path.node.begin() + std::ptrdiff_t(path.size));
    return path;
  }

  /// What a move takes off the areas of the inner nodes; nothing where it is impossible or would make the tree too
  /// deep.
  [[nodiscard]] T gain(I node, I to) const noexcept {
    const Path from = path_to(node);
    const Path target = path_to(to);
    if (target.size + std::size_t(std::max(heights_[node], heights_[to])) > max_depth) return 0;
    std::size_t common = 0;
    while (common < std::min(from.size, target.size) && from.node[common] == target.node[common]) ++common;
    if (common == from.size || to == parent(node) || to == sibling(node)) return 0;  // below itself, or where it is
    const bool above = common == target.size;
    PackedBox<T> rest = boxes_[sibling(node)];
    T sum = area(parent(node));
    for (std::size_t i = from.size - 2; i-- > common - std::size_t(above);) {
      rest.extend(boxes_[sibling(from.node[i + 1])]);
      sum += area(from.node[i]) - rest.half_area();
    }
    if (above) return sum - area(to);
    for (std::size_t i = common; i != target.size; ++i) {
      PackedBox<T> both = boxes_[node];
      both.extend(boxes_[target.node[i]]);
      sum -= both.half_area() - (i + 1 == target.size ? T(0) : area(target.node[i]));
    }
    return sum;
  }

  void adopt_children(I node) noexcept {
    if (is_inner(node)) parents_[links_[node].first / 2] = node;
  }
  /// What was the node `from` becomes the node `to`.
  void transfer(I from, I to) noexcept {
    boxes_[to] = boxes_[from];
    links_[to] = links_[from];
    heights_[to] = heights_[from];
    adopt_children(to);
  }
  void fit(I node) noexcept {
    const I first = links_[node].first;
    PackedBox<T> box = boxes_[first];
    box.extend(boxes_[first + 1]);
    boxes_[node] = box;
    heights_[node] = std::uint8_t(std::max(heights_[first], heights_[first + 1]) + 1);
  }
  void fit_above(I node) noexcept {
    while (node != root) {
      node = parent(node);
      fit(node);
    }
  }

  std::vector<PackedBox<T>> boxes_;
  std::vector<Link> links_;
  std::vector<std::uint8_t> heights_;  ///< steps to the deepest leaf below
  std::vector<I> parents_;             ///< of pairs of siblings
};

/// Returns what the cost fell by.
template <std::floating_point T, std::unsigned_integral I, typename Executor>
[[nodiscard]] double reinsertion_round(Reinserter<T, I>& reinserter, float batch, const Executor& executor) {
  using Move = typename Reinserter<T, I>::Move;
  const std::vector<I> nodes = reinserter.most_wasteful(batch);
  std::vector<Move> moves(nodes.size());
  executor.parallel_for(nodes.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) moves[i] = reinserter.best_move(nodes[i]);
  });
  std::erase_if(moves, [](const Move& move) { return !(move.gain > T(0)); });
  std::sort(moves.begin(), moves.end(),
            [](const Move& a, const Move& b) { return a.gain > b.gain || (a.gain == b.gain && a.node < b.node); });
  double gain = 0;
  for (const Move& move : moves) gain += double(reinserter.apply(move));
  return gain;
}

}  // namespace detail

/// A better tree over the same leaves: nodes are taken out and put back where they cost least, until that gains little.
///
/// A round looks for the best places of a batch of nodes, all in the same tree; then the moves are made in the order of
/// their gains, each only if it still is a gain in the tree that the moves before it have left. So moves need no locks
/// and the cost falls with every one.
///
/// Requires: a valid tree; primitives may be in several leaves.
/// Ensures:  a valid tree of the same leaves, no deeper than Tree::max_depth, whose statistics' cost is not larger;
///           nodes are numbered depth first.
/// Cost:     about O(rounds · batch · nodes · log nodes).
/// Threads:  places are looked for in parallel; the same tree for every executor.
/// Source:   Meister, Bittner, "Parallel Reinsertion for Bounding Volume Hierarchy Optimization", CGF 37(2), 2018,
///           whose moves exclude each other where they touch the same nodes.
template <std::floating_point T, std::unsigned_integral I, Executor E = Serial>
[[nodiscard]] Tree<T, I> reinsert(const Tree<T, I>& tree, const Reinsertion& options = {}, const E& executor = {}) {
  Tree<T, I> numbered = depth_first(tree);
  if (tree.nodes.empty()) return numbered;
  detail::Reinserter<T, I> reinserter(numbered);
  for (int round = 0; round < options.rounds; ++round) {
    const double enough = double(options.least_gain) * reinserter.cost();
    if (!(detail::reinsertion_round(reinserter, options.batch, executor) > enough)) break;
  }
  Tree<T, I> result = depth_first(reinserter.tree(numbered.order));
  result.left_out = tree.left_out;
  return statistics(result).sah_cost <= statistics(numbered).sah_cost ? result : numbered;  // but for rounding
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint::testing {

/// An executor that does everything in the opposite order, in the smallest pieces it may: what depends on the order of
/// work, or on how it is cut, comes out differently from Serial.
struct Backwards {
  [[nodiscard]] static constexpr int concurrency() noexcept { return 3; }

  template <std::invocable<std::size_t, std::size_t> Body>
  static void parallel_for(std::size_t n, std::size_t grain, Body&& body) {
    while (n != 0) {
      const std::size_t begin = n - std::min(n, std::max<std::size_t>(1, grain));
      body(begin, n);
      n = begin;
    }
  }
  template <std::invocable F, std::invocable G>
  static void invoke(F&& f, G&& g) {
    std::forward<G>(g)();
    std::forward<F>(f)();
  }
};
static_assert(Executor<Backwards>);

/// The laws of BuilderFor, for one set: the tree is valid, and the same for every executor and every time.
///
/// Pass sets of all kinds: none, one, equal ones, ones without a box, tens of thousands so that work is cut; for
/// builders that cut primitives, a ClippableSet too.
template <BoundedSet S, BuilderFor<S> Builder>
[[nodiscard]] std::vector<std::string> violations_of_builder_laws(const Builder& builder, const S& set) {
  const auto tree = builder.build(set, Serial{});
  std::vector<std::string> broken = violations(tree, set);
  if (!(builder.build(set, Serial{}) == tree)) broken.emplace_back("built twice, the tree is not the same");
  if (!(builder.build(set, Backwards{}) == tree)) broken.emplace_back("the tree depends on the executor");
  return broken;
}

}  // namespace glint::testing

// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/concepts.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {
namespace detail {

template <int N, std::floating_point T>
[[nodiscard]] BoxPack<T, N> packed(const std::array<Aabb<T>, std::size_t(N)>& boxes) {
  BoxPack<T, N> pack;
  for (std::size_t plane = 0; plane < 6; ++plane) {
    std::array<T, std::size_t(N)> values;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      values[i] = component(plane < 3 ? boxes[i].lower : boxes[i].upper, int(plane % 3));
    pack.planes[plane] = Pack<T, N>::load(values.data());
  }
  return pack;
}

/// Boxes in and about a region, and boxes that hold them.
template <int N, std::floating_point T>
struct NestedBoxes {
  std::array<Aabb<T>, std::size_t(N)> inner;
  std::array<Aabb<T>, std::size_t(N)> outer;

  NestedBoxes(const Aabb<T>& region, Random& random) {
    const auto box = [&] {
      const Vec3<T> lower = random_point(region, random);
      const Vec3<T> size = extent(region) * random.uniform_vec3<T>() * random.uniform(T(0), T(0.5));
      return Aabb<T>{lower, lower + size};
    };
    for (std::size_t i = 0; i < inner.size(); ++i) {
      inner[i] = outer[i] = box();
      extend(outer[i], box());
    }
  }
};

}  // namespace detail

/// What a query breaks of the laws of QueryFor, for boxes in and about a region, a sentence each; nothing where it
/// keeps them all.
///
/// - A box that holds one that matters matters, with a key that is no larger: no walk then loses a leaf.
/// - What a box is told does not depend on its siblings.
///
/// Requires: a query that some boxes in the region matter to and others do not.
template <int N, std::floating_point T, QueryFor<T, N> Query>
[[nodiscard]] std::vector<std::string> violations_of_query_laws(const Query& query, const Aabb<T>& region,
                                                                std::uint64_t seed, int trials = 2000) {
  Violations violations;
  Random random{seed};
  for (int trial = 0; trial < trials; ++trial) {
    const std::string which = "trial " + std::to_string(trial);
    detail::NestedBoxes<N, T> boxes(region, random);
    const auto inner = query.enter(detail::packed<N>(boxes.inner));
    const auto outer = query.enter(detail::packed<N>(boxes.outer));
    violations.expect((inner.mask & ~outer.mask) == 0, "a box that holds one that matters matters", which);
    for (int i = 0; Query::ordered && i < N; ++i) {
      const bool matter = (inner.mask & outer.mask & (1U << i)) != 0;
      violations.expect(!matter || outer.key[i] <= inner.key[i], "a box that holds another has no larger key", which);
    }
    std::swap(boxes.inner.front(), boxes.inner.back());
    const auto swapped = query.enter(detail::packed<N>(boxes.inner));
    violations.expect((inner.mask & 1U) == (swapped.mask >> (N - 1) & 1U), "a box does not depend on its siblings",
                      which);
  }
  return violations.take();
}

}  // namespace glint::testing

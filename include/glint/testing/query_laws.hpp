// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
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
  const auto box = [&] {
    const Vec3<T> a = detail::random_point(region, random);
    const Vec3<T> size = extent(region) * random.uniform_vec3<T>() * random.uniform(T(0), T(0.5));
    return Aabb<T>{a, a + size};
  };
  for (int trial = 0; trial < trials; ++trial) {
    std::array<Aabb<T>, std::size_t(N)> small;
    std::array<Aabb<T>, std::size_t(N)> large;
    for (std::size_t i = 0; i < small.size(); ++i) {
      small[i] = box();
      large[i] = small[i];
      extend(large[i], box());
    }
    const auto inner = query.enter(detail::packed<N>(small));
    const auto outer = query.enter(detail::packed<N>(large));
    std::swap(small.front(), small.back());
    const auto swapped = query.enter(detail::packed<N>(small));
    const std::uint32_t last = 1U << (N - 1);
    violations.expect(((inner.mask & 1U) != 0) == ((swapped.mask & last) != 0), "a box does not depend on its siblings",
                      "trial " + std::to_string(trial));
    violations.expect((inner.mask & ~outer.mask) == 0, "a box that holds one that matters matters",
                      "trial " + std::to_string(trial));
    if constexpr (Query::ordered) {
      for (int i = 0; i < N; ++i) {
        if ((inner.mask & outer.mask & (1U << i)) == 0) continue;
        violations.expect(outer.key[i] <= inner.key[i], "a box that holds another has no larger key",
                          double(outer.key[i]), double(inner.key[i]));
      }
    }
  }
  return violations.take();
}

}  // namespace glint::testing

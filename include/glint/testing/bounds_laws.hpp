// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {

namespace detail {

/// Whether one of many random rays in the slice of a box across an axis at `at` meets the primitive.
template <Primitive P, std::floating_point T>
[[nodiscard]] bool is_met_in_slice(const P& primitive, const Aabb<T>& box, int axis, T at, Random& random) {
  constexpr int rays = 20000;
  const auto in_slice = [&](Vec3<T> p) {
    set_component(p, static_cast<std::uint32_t>(axis), at);
    return p;
  };
  for (int i = 0; i < rays; ++i) {
    const Vec3<T> from = in_slice(random_point(box, random));
    const Vec3<T> to = in_slice(random_point(box, random));
    const Ray<T> ray{from - (to - from) * T(16), to - from};
    if (intersect(ray, primitive)) return true;
  }
  return false;
}

}  // namespace detail

/// Which sides of its box a primitive does not come near to: for each side, rays within the slice that is `share` of
/// the box's extent away from it must meet the primitive. That the box holds the primitive is a law of Primitive
/// itself.
///
/// Requires: a box with volume; `share` so large that the slices of the primitive are not too small to be met by
/// chance. Cost:     up to 10⁵ intersections.
template <Primitive P>
[[nodiscard]] std::vector<std::string> violations_of_tight_bounds(const P& primitive, std::uint64_t seed,
                                                                  ScalarOf<P> share = ScalarOf<P>(0.02)) {
  using T = ScalarOf<P>;
  const Aabb<T> box = bounds(primitive);
  Random random(seed);
  Violations violations;
  for (int axis = 0; axis < 3; ++axis) {
    const T inward = share * component(extent(box), axis);
    for (const T at : {component(box.lower, axis) + inward, component(box.upper, axis) - inward}) {
      const bool is_lower = at < component(centroid(box), axis);
      const std::string law =
          std::string("the bounds are tight at the ") + (is_lower ? "lower " : "upper ") + "xyz"[axis];
      violations.expect(detail::is_met_in_slice(primitive, box, axis, at, random), law.c_str(),
                        "nothing was met there");
    }
  }
  return violations.take();
}

}  // namespace glint::testing

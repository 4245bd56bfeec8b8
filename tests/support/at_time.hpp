// SPDX-License-Identifier: MIT
#pragma once
#include <glint/geometry/ray.hpp>

namespace support {

/// A ray caster whose rays all have one time.
template <typename G>
struct AtTime {
  using Scalar = typename G::Scalar;
  using Index = typename G::Index;
  const G& scene;
  Scalar time;

  [[nodiscard]] auto bounds() const { return scene.bounds(); }
  [[nodiscard]] auto closest(const glint::Ray<Scalar>& ray) const { return scene.closest(timed(ray)); }
  [[nodiscard]] bool occluded(const glint::Ray<Scalar>& ray) const { return scene.occluded(timed(ray)); }

 private:
  [[nodiscard]] glint::Ray<Scalar> timed(glint::Ray<Scalar> ray) const {
    ray.time = time;
    return ray;
  }
};
template <typename G, typename T>
AtTime(const G&, T) -> AtTime<G>;

}  // namespace support

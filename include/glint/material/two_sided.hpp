// SPDX-License-Identifier: MIT
#pragma once
#include <glint/bsdf/two_sided.hpp>
#include <glint/material/concepts.hpp>

namespace glint {

/// A material that looks the same from both sides.
template <Material M>
struct TwoSidedMaterial {
  M front;

  [[nodiscard]] auto bsdf(const Surface& at) const { return TwoSided{bsdf_at(front, at, 0)}; }

  [[nodiscard]] friend bool operator==(const TwoSidedMaterial&, const TwoSidedMaterial&) = default;
};

template <Material M>
TwoSidedMaterial(M) -> TwoSidedMaterial<M>;

}  // namespace glint

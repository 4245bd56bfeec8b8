// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <vector>

#include <glint/core/config.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/material/concepts.hpp>

namespace glint {

/// Which primitive is made of what: materials, and an index into them for each primitive.
///
/// Requires: every index is below materials.size(), and there is one for each primitive of the scene.
template <Material M>
struct MaterialTable {
  std::vector<M> materials{};
  std::vector<std::uint32_t> of_primitive{};

  [[nodiscard]] BsdfOf<M> bsdf(const Surface& at, std::uint64_t primitive) const {
    GLINT_ASSERT(primitive < of_primitive.size() && of_primitive[primitive] < materials.size());
    return bsdf_at(materials[of_primitive[primitive]], at, primitive);
  }
};

}  // namespace glint

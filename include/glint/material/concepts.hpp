// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <utility>

#include <glint/bsdf/concepts.hpp>
#include <glint/geometry/surface.hpp>

namespace glint {

/// What a surface is made of: `bsdf(surface)` is how it scatters light at one point. A BSDF alone is the material that
/// is alike everywhere.
template <typename M>
concept Material = Bsdf<M> || requires(const M& material, const Surface& at) {
  { material.bsdf(at) } -> Bsdf;
};

/// Materials by primitive: `bsdf(surface, primitive)`.
template <typename M>
concept MaterialTableLike = requires(const M& materials, const Surface& at, std::uint64_t primitive) {
  { materials.bsdf(at, primitive) } -> Bsdf;
};

/// The BSDF at a point: of a table, of a material, or the BSDF itself.
template <typename M>
  requires(Material<M> || MaterialTableLike<M>)
[[nodiscard]] auto bsdf_at(const M& materials, const Surface& at, std::uint64_t primitive) {
  if constexpr (MaterialTableLike<M>) {
    return materials.bsdf(at, primitive);
  } else if constexpr (Bsdf<M>) {
    return materials;
  } else {
    return materials.bsdf(at);
  }
}

/// The type of BSDF that a material or table hands out.
template <typename M>
using BsdfOf = decltype(bsdf_at(std::declval<const M&>(), std::declval<const Surface&>(), 0));

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <utility>

#include <glint/bsdf/concepts.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/surface.hpp>

namespace glint {

/// A material that hands out a BSDF for each point of a surface: `bsdf(surface)`.
template <typename M>
concept BsdfSource = requires(const M& material, const Surface& at) {
  { material.bsdf(at) } -> Bsdf;
};

namespace detail {

template <typename M>
inline constexpr bool is_choice_of_materials = false;
template <typename... Ms>
inline constexpr bool is_choice_of_materials<OneOf<Ms...>> = ((Bsdf<Ms> || BsdfSource<Ms>)&&...);

}  // namespace detail

/// What a surface is made of: something that hands out BSDFs, a BSDF (the material that is alike everywhere), or one of
/// several of these.
template <typename M>
concept Material = Bsdf<M> || BsdfSource<M> || detail::is_choice_of_materials<M>;

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
  } else if constexpr (BsdfSource<M>) {
    return materials.bsdf(at);
  } else {
    return materials.transform([&](const auto& material) { return bsdf_at(material, at, primitive); });
  }
}

/// The type of BSDF that a material or table hands out.
template <typename M>
using BsdfOf = decltype(bsdf_at(std::declval<const M&>(), std::declval<const Surface&>(), 0));

}  // namespace glint

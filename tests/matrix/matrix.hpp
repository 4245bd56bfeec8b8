// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/set/masked.hpp>
#include <glint/math/affine.hpp>

#include <matrix/kinds.hpp>
#include <matrix/oracle.hpp>
#include <support/catch.hpp>

/// Primitives × adaptors × builders × layouts × queries × scalars: everything that is meant to be composed, composed.
namespace glint::testing {

template <BoundedSet S>
[[nodiscard]] auto trees_over(const S& set) {
  std::vector<std::pair<std::string, Tree<typename S::Scalar, typename S::Index>>> trees;
  trees.emplace_back("Median", Median{}.build(set));
  trees.emplace_back("BinnedSah", BinnedSah{}.build(set));
  trees.emplace_back("SweepSah", SweepSah{}.build(set));
  trees.emplace_back("Morton", Morton{}.build(set));
  trees.emplace_back("SpatialSah", SpatialSah{}.build(set));
  trees.emplace_back("Quality::Best", QualityBuilder{Quality::Best}.build(set));
  return trees;
}

/// The layouts that each combination of the others is tried with: all, or the one of a Bvh that is not told.
inline constexpr auto every_layout = std::make_tuple(
    std::pair{"binary", binary}, std::pair{"wide<4>", wide<4>}, std::pair{"wide<8>", wide<8>},
    std::pair{"wide<8, IndexedBlocks<4>>", wide<8, IndexedBlocks<4>>}, std::pair{"quantized<8>", quantized<8>});
inline constexpr auto default_layout = std::make_tuple(std::pair{"wide<8>", wide<8>});

/// Every builder's tree in these layouts, asked every query.
template <PrimitiveSet S, typename Layouts>
void check_set(const std::string& adaptor, const S& set, const Layouts& layouts) {
  const auto trees = trees_over(set);
  const Oracle<S> oracle(set, trees.front().second.nodes.front().bounds, 80);
  CAPTURE(adaptor);
  CHECK(oracle.hit_count() > 10);
  const auto check_layout = [&](const auto& named) {
    for (const auto& [builder, tree] : trees) {
      CAPTURE(builder, named.first);
      CHECK(oracle.disagreements(Bvh(set, tree, named.second)) == std::vector<std::string>{});
    }
  };
  std::apply([&](const auto&... named) { (check_layout(named), ...); }, layouts);
}

inline constexpr auto two_of_three = [](const auto& /*ray*/, const auto& hit) { return hit.primitive % 3 != 0; };

/// Turned, scaled unevenly and mirrored.
template <std::floating_point T>
[[nodiscard]] Affine<T> skewed() {
  return Affine<T>::translate({T(0.4), T(-0.3), T(0.2)}) * Affine<T>::rotate({1, 2, T(0.5)}, T(0.8)) *
         Affine<T>::scale({T(-0.7), T(1.3), T(0.4)});
}

/// A set as it is, and in every adaptor.
template <PrimitiveSet S, typename Layouts>
void check_adaptors(const S& set, const Layouts& layouts) {
  using T = typename S::Scalar;
  const auto spheres = kinds::spheres<T>();
  std::vector<std::uint32_t> masks(set.size(), ~0U);
  for (std::size_t i = 0; i < masks.size(); i += 3) masks[i] = 0;
  const Bvh object{set};
  const std::vector placed{place(object, Affine<T>{}), place(object, skewed<T>())};
  check_set("none", set, layouts);
  check_set("Filtered", Filtered{set, two_of_three}, layouts);
  check_set("Masked", Masked{set, masks}, layouts);
  check_set("Joined", Joined{Elements{spheres}, set}, layouts);
  check_set("Instanced", Instanced{placed}, layouts);
}

/// Adaptors of adaptors.
template <PrimitiveSet S, typename Layouts>
void check_nested_adaptors(const S& set, const Layouts& layouts) {
  using T = typename S::Scalar;
  const Bvh object{Filtered{set, two_of_three}};
  const std::vector placed{place(object, Affine<T>{}), place(object, skewed<T>())};
  const Bvh stand{Joined{set, Instanced{placed}}};
  const std::vector nested{place(stand, skewed<T>()), place(stand, Affine<T>::translate({1, 0, 0}))};
  check_set("Instanced<Joined<Instanced<Filtered>>>", Instanced{nested}, layouts);
  check_set("Filtered<Joined<Instanced>>", Filtered{Joined{set, Instanced{placed}}, two_of_three}, layouts);
}

}  // namespace glint::testing

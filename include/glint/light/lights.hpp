// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/core/index.hpp>
#include <glint/light/concepts.hpp>

namespace glint {

/// The lights of a scene, and which of its primitives shine.
///
/// `of_primitive` holds an index into `all` for each primitive, none<std::uint32_t> for those that do not shine; empty
/// where no primitive does. A SurfaceLight whose primitives are not named there lights the scene but is not seen.
template <Light L>
struct Lights {
  std::vector<L> all;
  std::vector<std::uint32_t> of_primitive{};

  [[nodiscard]] std::uint32_t at_primitive(std::uint64_t primitive) const noexcept {
    return primitive < of_primitive.size() ? of_primitive[primitive] : none<std::uint32_t>;
  }
};

template <Light L>
Lights(std::vector<L>) -> Lights<L>;
template <Light L>
Lights(std::vector<L>, std::vector<std::uint32_t>) -> Lights<L>;

/// The light that is not there: for scenes without lights.
struct Darkness {
  static constexpr bool is_delta = true;

  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& /*from*/,
                                                  const Vec2<float>& /*u*/) const noexcept {
    return std::nullopt;
  }
  [[nodiscard]] Rgb power(const Aabb<float>& /*scene*/) const noexcept { return {}; }
};

}  // namespace glint

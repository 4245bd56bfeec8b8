// SPDX-License-Identifier: MIT
#pragma once
#include <glint/math/vec.hpp>

namespace glint {

/// Texture coordinates from surface coordinates: st = scale · uv + delta.
struct UvMapping {
  Vec2<float> scale{1.0F, 1.0F};
  Vec2<float> delta{0.0F, 0.0F};

  [[nodiscard]] constexpr Vec2<float> operator()(const Vec2<float>& uv) const noexcept { return scale * uv + delta; }

  [[nodiscard]] friend constexpr bool operator==(const UvMapping&, const UvMapping&) noexcept = default;
};

}  // namespace glint

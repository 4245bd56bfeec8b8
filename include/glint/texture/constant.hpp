// SPDX-License-Identifier: MIT
#pragma once
#include <glint/texture/concepts.hpp>

namespace glint {

/// The same color everywhere.
struct ConstantTexture {
  Rgb color{1};

  [[nodiscard]] constexpr Rgb evaluate(const Vec2<float>& /*uv*/) const noexcept { return color; }

  [[nodiscard]] friend constexpr bool operator==(const ConstantTexture&, const ConstantTexture&) noexcept = default;
};

static_assert(Texture<ConstantTexture>);

}  // namespace glint

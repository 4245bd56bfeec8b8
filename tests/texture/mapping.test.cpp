// SPDX-License-Identifier: MIT
#include <glint/texture/mapping.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_texture_mapping {

TEST_CASE("uv mapping: scales, then shifts", "[texture][mapping]") {
  const glint::UvMapping mapping{.scale = {2, 4}, .delta = {0.5F, -1}};
  CHECK(mapping({3, 0.25F}) == glint::Vec2<float>(6.5F, 0));
  CHECK(glint::UvMapping{}({3, 0.25F}) == glint::Vec2<float>(3, 0.25F));
}

}  // namespace test_texture_mapping

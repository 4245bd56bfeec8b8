// SPDX-License-Identifier: MIT
#include <glint/texture/constant.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_texture_constant {

TEST_CASE("constant texture: is the same color everywhere", "[texture][constant]") {
  const glint::ConstantTexture texture{{0.1F, 0.2F, 0.3F}};
  CHECK(texture.evaluate({0, 0}) == glint::Rgb{0.1F, 0.2F, 0.3F});
  CHECK(texture.evaluate({-7, std::numeric_limits<float>::quiet_NaN()}) == glint::Rgb{0.1F, 0.2F, 0.3F});
  CHECK(glint::ConstantTexture{}.evaluate({0, 0}) == glint::Rgb{1});
}

}  // namespace test_texture_constant

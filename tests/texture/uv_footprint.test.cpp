// SPDX-License-Identifier: MIT
#include <glint/texture/uv_footprint.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_texture_uv_footprint {

namespace {

using glint::Surface;
using glint::UvFootprint;
using glint::Vec2;

}  // namespace

TEST_CASE("uv footprint: undoes the tangents, however skewed they are", "[texture][uv_footprint]") {
  glint::Random random(1);
  for (int i = 0; i < 100; ++i) {
    Surface at{.tangent = random.uniform_vec3<float>() - 0.5F, .bitangent = random.uniform_vec3<float>() * 30.0F};
    const UvFootprint expected{{0.5F, -0.25F}, {random.uniform<float>(), 1}};
    at.footprint = {at.tangent * expected.x.x + at.bitangent * expected.x.y,
                    at.tangent * expected.y.x + at.bitangent * expected.y.y};
    const UvFootprint found = uv_footprint(at);
    CHECK(found.x.x == Approx(expected.x.x).margin(0.01));
    CHECK(found.x.y == Approx(expected.x.y).margin(0.01));
    CHECK(found.y.x == Approx(expected.y.x).margin(0.01));
    CHECK(found.y.y == Approx(expected.y.y).margin(0.01));
  }
}

TEST_CASE("uv footprint: is zero without a parametrization", "[texture][uv_footprint]") {
  const glint::Footprint footprint{{1, 0, 0}, {0, 1, 0}};
  CHECK(uv_footprint(Surface{.footprint = footprint}) == UvFootprint{});
  CHECK(uv_footprint(Surface{.tangent = {1, 0, 0}, .footprint = footprint}) == UvFootprint{});
  CHECK(uv_footprint(Surface{.tangent = {1, 2, 3}, .bitangent = {2, 4, 6}, .footprint = footprint}) == UvFootprint{});
  CHECK(uv_footprint(Surface{.tangent = {2, 0, 0}, .bitangent = {0, 4, 0}}) == UvFootprint{});
}

}  // namespace test_texture_uv_footprint

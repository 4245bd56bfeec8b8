// SPDX-License-Identifier: MIT
// Paints the two images that the scenes of the Cornell box use: poster.png, a picture for the back wall, and sky.hdr,
// an environment with a sun.
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <glint/color/image.hpp>
#include <glint/io/image.hpp>
#include <glint/math/spherical.hpp>

namespace {

glint::Rgb mix(const glint::Rgb& a, const glint::Rgb& b, float share) {
  return a + (b - a) * std::clamp(share, 0.0F, 1.0F);
}

/// A color for each point of an image: `paint(uv)`, (0, 0) the upper left corner.
template <typename Paint>
glint::Image painted(glint::Vec2i size, const Paint& paint) {
  glint::Image image(size);
  for (int y = 0; y < size.y; ++y) {
    for (int x = 0; x < size.x; ++x) {
      image(x, y) = paint((glint::Vec2<float>{x, y} + 0.5F) / glint::Vec2<float>(size));
    }
  }
  return image;
}

/// An evening by the sea: the sun is cut in stripes, finer toward its top.
glint::Rgb poster(const glint::Vec2<float>& uv) {
  if (uv.y > 0.7F) return mix({0.02F, 0.03F, 0.12F}, {0.3F, 0.1F, 0.25F}, 0.5F + 0.5F * std::sin(40 / (uv.y - 0.6F)));
  const float from_sun = glm::length(uv - glint::Vec2<float>{0.5F, 0.5F});
  const float below_top = (uv.y - 0.25F) / 0.5F;
  const bool stripe = below_top > 0.3F && std::fmod(10 * below_top * below_top, 1.0F) < 0.45F * below_top;
  if (from_sun < 0.25F && !stripe) return mix({0.9F, 0.7F, 0.1F}, {0.8F, 0.1F, 0.2F}, below_top);
  return mix({0.05F, 0.02F, 0.2F}, {0.7F, 0.2F, 0.25F}, uv.y / 0.7F);
}

/// Blue at the zenith, pale at the horizon, brown ground, and a sun of five degrees around.
glint::Rgb sky(const glint::Vec2<float>& uv) {
  const auto direction = glint::equirectangular_to_direction(uv);
  const auto to_sun = glm::normalize(glint::Vec3<float>{0.25F, 1.0F, -0.55F});
  if (glm::dot(direction, to_sun) > std::cos(glint::radians(5.0F))) return {160, 140, 110};
  if (direction.y < 0) return {0.12F, 0.1F, 0.08F};
  return mix({1.0F, 0.95F, 0.9F}, {0.2F, 0.4F, 0.9F}, std::sqrt(direction.y));
}

}  // namespace

int main() {
  glint::write_png(painted({256, 256}, poster), "poster.png");
  glint::write_hdr(painted({128, 64}, sky), "sky.hdr");
}

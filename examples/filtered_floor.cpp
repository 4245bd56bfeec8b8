// SPDX-License-Identifier: MIT
// Renders a floor of tiles to the horizon, and a ball that mirrors it, with few samples: once looked up at points, once
// filtered. Writes floor_bilinear.png and floor_ewa.png, and says how noisy each is.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <vector>

#include <glint/glint.hpp>

namespace {

/// Blue and white tiles, four by four, with dark joints.
glint::Image tiles() {
  glint::Image image(glint::Vec2i{256, 256});
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const bool joint = x % 64 < 4 || y % 64 < 4;
      const bool blue = (x / 64 + y / 64) % 2 != 0;
      image(x, y) = joint ? glint::Rgb{0.02F} : blue ? glint::Rgb{0.08F, 0.15F, 0.4F} : glint::Rgb{0.8F, 0.78F, 0.7F};
    }
  }
  return image;
}

/// The scene with one kind of texture or another on the floor.
template <typename Texture>
glint::Image rendered(const Texture& texture, int samples) {
  const std::vector<glint::Quad<float>> floor{{{-200, 0, 10}, {400, 0, 0}, {0, 0, -400}}};
  const std::vector<glint::Sphere<float>> balls{{.center = {1.2F, 1, -4}, .radius = 1}};
  const glint::Joined set{glint::Elements{floor}, glint::Elements{balls}};
  using Material = glint::OneOf<glint::Textured<glint::Lambertian, Texture>, glint::Mirror>;
  const glint::MaterialTable<Material> materials{
      {glint::Textured<glint::Lambertian, Texture>{texture}, glint::Mirror{{0.9F}}}, {0, 1}};
  const glint::Scene scene{glint::Bvh{set}, materials, glint::ConstantEnvironment{{0.9F, 1.0F, 1.2F}}};
  glint::Film film{{320, 180}};
  const glint::Perspective camera{.eye = {0, 1.2F, 1}, .target = {0.3F, 0.8F, -4}};
  glint::render(scene, camera, glint::Path{.max_depth = 4}, film, {.samples = samples}, glint::Serial{},
                glint::Stratified{.samples_per_pixel = samples});
  return film.develop();
}

/// The squared error toward the horizon, where tiles are much smaller than pixels.
double noise(const glint::Image& image, const glint::Image& converged) {
  double sum = 0;
  for (int y = 64; y < 76; ++y) {
    for (int x = 0; x < 120; ++x) sum += std::pow(double(image(x, y).g) - double(converged(x, y).g), 2);
  }
  return sum;
}

}  // namespace

int main() {
  // <region: textures>
  const auto image = std::make_shared<const glint::Image>(tiles());
  const glint::UvMapping often{{100, 100}, {0, 0}};
  const glint::ImageTexture plain{.image = image, .mapping = often};
  const glint::FilteredImageTexture filtered{.pyramid = std::make_shared<const glint::MipMap>(image), .mapping = often};
  // </region: textures>
  const glint::Image bilinear = rendered(plain, 4);
  const glint::Image ewa = rendered(filtered, 4);
  glint::write_png(bilinear, "floor_bilinear.png");
  glint::write_png(ewa, "floor_ewa.png");

  const glint::Image converged = rendered(plain, 256);
  const double ratio = noise(bilinear, converged) / noise(ewa, converged);
  std::printf("toward the horizon, bilinear lookups have %.0f times the squared error\n", ratio);
  return ratio > 3 ? EXIT_SUCCESS : EXIT_FAILURE;
}

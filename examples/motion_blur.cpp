// SPDX-License-Identifier: MIT
// A blob flies by while the shutter is open. The blurred picture is what the mean of many still ones is. Writes
// motion_blur.png.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/shutter.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/set/moving.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/integrator/path.hpp>
#include <glint/io/image.hpp>
#include <glint/light/environment.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

/// The mean of a part of the picture's columns, black to white.
double mean_of_columns(const glint::Image& image, int begin, int end) {
  double sum = 0;
  for (int y = 0; y < image.size().y; ++y)
    for (int x = begin; x < end; ++x) sum += double(image(x, y).g);
  return sum / double((end - begin) * image.size().y);
}

}  // namespace

int main() {
  const auto early = glint::testing::scanned_blob<float>(5000, 1);
  auto late = early;
  for (glint::Vec3<float>& p : late.positions) p += glint::Vec3<float>{1.5F, 0.5F * p.x, 0};
  const glint::Perspective camera{.eye = {0.75F, 0.5F, 4}, .target = {0.75F, 0, 0}};
  glint::Film film{{160, 96}};

  // <region: moving>
  const glint::Scene scene{glint::Bvh{glint::Moving{view(early), view(late)}}, glint::Lambertian{{0.5F, 0.15F, 0.05F}},
                           glint::ConstantEnvironment{glint::Rgb{1}}};
  glint::render(scene, glint::Shutter{camera}, glint::Path{.max_depth = 3}, film, {.samples = 64});
  // </region: moving>
  const glint::Image blurred = film.develop();
  glint::write_png(blurred, "motion_blur.png");

  constexpr int moments = 32;
  constexpr int bands = 5;
  double still[bands] = {};
  for (int i = 0; i < moments; ++i) {
    const float time = (float(i) + 0.5F) / float(moments);
    glint::Film one{{160, 96}};
    glint::render(scene, glint::Shutter{camera, time, time}, glint::Path{.max_depth = 3}, one, {.samples = 2});
    for (int band = 0; band < bands; ++band)
      still[band] += mean_of_columns(one.develop(), band * 32, band * 32 + 32) / moments;
  }
  bool agrees = true;
  for (int band = 0; band < bands; ++band) {
    const double mean = mean_of_columns(blurred, band * 32, band * 32 + 32);
    std::printf("columns from %3d: %.4f blurred, %.4f as the mean of %d moments\n", band * 32, mean, still[band],
                moments);
    agrees = agrees && std::abs(mean - still[band]) < 0.005;
  }
  return agrees ? 0 : 1;
}

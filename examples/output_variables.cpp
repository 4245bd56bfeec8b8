// SPDX-License-Identifier: MIT
// Depth, normals, albedo and more beside a picture: balls.exr with all layers, and a PNG of each as it is read back.
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/glint.hpp>

namespace aov = glint::aov;

// <region: own>
/// How directly a surface faces the eye.
struct Facing {
  using Value = float;
  static constexpr std::string_view name = "facing";
  static constexpr std::array<std::string_view, 1> channels{"facing"};

  template <glint::SceneLike S>
  std::optional<float> at_surface(const S&, const glint::Ray<float>&, const auto& at, const auto& /*sampler*/) const {
    if (!at) return std::nullopt;
    return std::abs(glm::dot(at->wo, at->frame.z));
  }
};
// </region: own>

/// Depth as gray from 1, near, to 0.
glint::Image shown(glint::Image image, std::string_view layer) {
  for (glint::Rgb& c : image.pixels()) {
    if (layer == "Z") c = glint::Rgb(4 / std::max(4.0F, c.r));
    if (layer == "N" || layer == "denoise_normal") c = c * 0.5F + glint::Rgb(0.5F);
  }
  return image;
}

int main() {
  using Surface = glint::OneOf<glint::Lambertian, glint::Mirror, glint::Dielectric>;
  const std::vector<glint::Quad<float>> floor{{{-6, -1, 6}, {12, 0, 0}, {0, 0, -12}}};
  const std::vector<glint::Sphere<float>> balls{{{-2.2F, 0, 0}, 1}, {{0, 0, 0}, 1}, {{2.2F, 0, 0}, 1}};
  const glint::MaterialTable<Surface> materials{
      {glint::Lambertian{{0.6F, 0.5F, 0.4F}}, glint::Lambertian{{0.7F, 0.1F, 0.1F}}, glint::Mirror{0.9F},
       glint::Dielectric{}},
      {0, 1, 2, 3}};
  const glint::Scene scene{glint::Bvh{glint::Joined{glint::Elements{floor}, glint::Elements{balls}}}, materials,
                           glint::ConstantEnvironment{{0.7F, 0.8F, 1}}};
  const glint::Perspective camera{.eye = {0, 1.5F, 7}, .target = {0, -0.2F, 0}};

  // <region: render>
  glint::Film film{{320, 160}};
  glint::AovLayers variables{film.size(),          aov::Albedo{},   aov::Normal{},      aov::DenoiseAlbedo{},
                             aov::DenoiseNormal{}, aov::Depth{},    aov::PrimitiveId{}, aov::Emission{},
                             aov::Direct{},        aov::Indirect{}, aov::Variance{},    Facing{}};
  glint::render(scene, camera, glint::Path{}, film, variables, {.samples = 32});

  glint::Layers picture = std::move(variables).layers();
  add_image(picture, film.develop());  // R, G and B
  write_exr_layers(picture, "balls.exr");
  // </region: render>

  // <region: read>
  const glint::Layers read = glint::read_exr_layers("balls.exr");
  for (const auto& layer : layer_names(read)) {
    write_png(shown(*image_of(read, layer), layer), "balls_" + (layer.empty() ? "picture" : layer) + ".png");
  }
  // </region: read>

  const auto mean = [&](const char* layer) {
    double sum = 0;
    const glint::Image image = *image_of(read, layer);
    for (const glint::Rgb& c : image.pixels()) sum += double(c.g) / double(image.pixels().size());
    return sum;
  };
  const double parts = mean("emission") + mean("direct") + mean("indirect");
  std::printf("emission, direct and indirect light: %.6f; the picture: %.6f\n", parts, mean(""));
  return read.channels.size() == picture.channels.size() && std::abs(parts / mean("") - 1) < 1e-6 ? 0 : 1;
}

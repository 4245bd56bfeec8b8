// SPDX-License-Identifier: MIT
// A BSDF of one's own beside the library's, in one scene: writes velvet.png.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/core/one_of.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/path.hpp>
#include <glint/io/image.hpp>
#include <glint/light/environment.hpp>
#include <glint/material/material_table.hpp>
#include <glint/math/warp.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/bsdf_laws.hpp>

// <region: bsdf>
/// Cloth that shines where it is seen at a grazing angle: f = color · (1 − cos θi) (1 − cos θo) · 2 / π.
struct Velvet {
  glint::Rgb color{0.8F};

  glint::Rgb evaluate(const glint::Vec3<float>& wo, const glint::Vec3<float>& wi) const {
    if (!(wo.z > 0 && wi.z > 0)) return 0;
    return color * ((1 - wi.z) * (1 - wo.z) * 2 * glint::inv_pi<float> * wi.z);
  }
  float pdf(const glint::Vec3<float>& wo, const glint::Vec3<float>& wi) const {
    return wo.z > 0 ? glint::cosine_hemisphere_pdf(wi.z) : 0;
  }
  std::optional<glint::BsdfSample> sample(const glint::Vec3<float>& wo, float /*u*/,
                                          const glint::Vec2<float>& uv) const {
    const auto wi = glint::cosine_hemisphere(uv);
    const float density = pdf(wo, wi);
    if (!(density > 0)) return std::nullopt;
    return glint::BsdfSample{wi, evaluate(wo, wi) / density, density, glint::Lobe::Diffuse};
  }
  static bool is_specular() { return false; }
};
// </region: bsdf>

int main() {
  // <region: laws>
  const auto broken =
      glint::testing::violations_of_bsdf_laws(Velvet{}, 1, {.seen_from = glint::testing::SeenFrom::Front});
  for (const std::string& law : broken) std::puts(law.c_str());
  // </region: laws>

  // <region: scene>
  const std::vector<glint::Sphere<float>> spheres{{{-1.1F, 0, 0}, 1}, {{1.1F, 0, 0}, 1}};
  const glint::MaterialTable<glint::OneOf<glint::Lambertian, Velvet>> materials{
      .materials = {glint::Lambertian{{0.6F, 0.1F, 0.1F}}, Velvet{{0.9F, 0.2F, 0.3F}}}, .of_primitive = {0, 1}};
  const glint::Scene scene{glint::Bvh{glint::Elements{spheres}}, materials, glint::ConstantEnvironment{0.7F}};
  // </region: scene>
  glint::Film film{{256, 144}};
  glint::render(scene, glint::Perspective{.eye = {0, 0, 5}}, glint::Path{.max_depth = 4}, film, {.samples = 32});
  glint::write_png(film.develop(), "velvet.png");
  return broken.empty() ? 0 : 1;
}

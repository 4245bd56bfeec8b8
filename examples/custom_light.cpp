// SPDX-License-Identifier: MIT
// A light of one's own: a sky that is brightest overhead. Writes sky.png.
#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/box.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/integrator/path.hpp>
#include <glint/io/image.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/warp.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/light_laws.hpp>

// <region: light>
/// Radiance in proportion to the height above the horizon, y up; nothing from below.
struct CloudySky {
  glint::Rgb zenith{1};

  glint::Rgb background(const glint::Vec3<float>& direction) const { return zenith * std::max(0.0F, direction.y); }
  float pdf(const glint::Vec3<float>& direction) const {
    return glint::cosine_hemisphere_pdf(std::max(0.0F, direction.y));
  }
  std::optional<glint::LightSample> sample(const glint::Vec3<float>& /*from*/, const glint::Vec2<float>& u) const {
    const auto local = glint::cosine_hemisphere(u);
    const glint::Vec3<float> wi{local.y, local.z, local.x};
    if (!(wi.y > 0)) return std::nullopt;
    return glint::LightSample{.wi = wi, .radiance = background(wi), .pdf = pdf(wi)};
  }
  /// What falls on a disk under the sky, as large as the scene.
  glint::Rgb power(const glint::Aabb<float>& scene) const {
    return zenith * (2 * glint::pi<float> / 3 * glint::length_squared(glint::extent(scene)));
  }
};
static_assert(glint::InfiniteLight<CloudySky>);
// </region: light>

int main() {
  const auto broken = glint::testing::violations_of_light_laws(CloudySky{}, {0, 0, 0}, 1);
  for (const std::string& law : broken) std::puts(law.c_str());

  const std::vector<glint::Box<float>> blocks{
      {{-9, -1, -9}, {9, 0, 9}}, {{-2, 0, -1}, {-1, 2.5F, 1}}, {{0, 0, -1}, {2, 1, 1}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{blocks}}, glint::Lambertian{0.7F}, CloudySky{{0.9F, 1.0F, 1.2F}}};
  glint::Film film{{256, 144}};
  glint::render(scene, glint::Perspective{.eye = {3, 3, 6}, .target = {0, 0.6F, 0}}, glint::Path{}, film,
                {.samples = 32});
  glint::write_png(film.develop(), "sky.png");
  return broken.empty() ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// A ball of hair: 2500 strands of three B-spline segments each, round, under a bright sky. Writes hair.png.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/curve_set.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/io/image.hpp>
#include <glint/light/environment.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>

namespace {

// <region: strands>
struct Hair {
  std::vector<glint::Vec3<float>> points;
  std::vector<float> radii;
  std::vector<std::uint32_t> firsts;  // of each segment, its first control point
};

/// Strands of six points: three segments, which share all points but one with the next.
Hair grow(int strands) {
  glint::Random random(7);
  Hair hair;
  for (int i = 0; i < strands; ++i) {
    const glm::vec3 out = glint::uniform_sphere(random.uniform_vec2<float>());
    const glm::vec3 comb = glm::vec3(0.5F, -1.2F, 0) + random.uniform_vec3<float>() * 0.3F;
    for (int k = 0; k < 6; ++k) {
      if (k < 3) hair.firsts.push_back(static_cast<std::uint32_t>(hair.points.size()));
      const float along = float(k - 1) * 0.3F;
      hair.points.push_back(out * (0.9F + along) + comb * (along * along));
      hair.radii.push_back(0.02F * (1 - float(k) / 6));
    }
  }
  return hair;
}
// </region: strands>

}  // namespace

int main() {
  const Hair hair = grow(2500);
  // <region: trace>
  const glint::CurveSet<float> strands{
      .positions = hair.points, .radii = hair.radii, .firsts = hair.firsts, .basis = glint::CurveBasis::BSpline};
  const std::vector<glint::Sphere<float>> scalp{{.radius = 0.9F}};
  const glint::Bvh geometry{glint::Joined{strands, glint::Elements{scalp}}};
  // </region: trace>

  const glint::Scene scene{geometry, glint::Lambertian{{0.5F, 0.3F, 0.15F}}, glint::ConstantEnvironment{1}};
  glint::Film film{{160, 160}};
  glint::render(scene, glint::Perspective{.eye = {0, 1, 5}, .target = {0.3F, -0.4F, 0}}, glint::Direct{}, film,
                {.samples = 9});
  glint::write_png(film.develop(), "hair.png");

  const auto hit = geometry.closest({.origin = {0, 0, 7}});
  std::printf("%zu segments; the first is met at t = %.3f\n", strands.size(), hit ? double(hit->t) : -1.0);
  return hit && hit->t > 4 && hit->t < 6.2F ? 0 : 1;
}

// SPDX-License-Identifier: MIT
// Hills with overhangs, which no grid of heights could hold: a surface given by a function, in cells under one tree,
// lit by a low sun and the sky. Writes terrain.png.
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/core/one_of.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/implicit_surface.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/io/image.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>
#include <glint/texture/noise.hpp>

namespace {

// <region: land>
/// Below zero in the ground. Noise of three dimensions bends the slopes over.
struct Land {
  float operator()(const glm::vec3& p) const {
    return p.y - 1.1F * glint::fbm({0.6F * p.x, 0.9F * p.y, 0.6F * p.z}, {.count = 3});
  }
};

/// The land in cells of one unit, so that a tree leads rays past the air and the ground.
std::vector<glint::ImplicitSurface<float, Land>> cells(int across) {
  std::vector<glint::ImplicitSurface<float, Land>> result;
  for (int x = -across; x < across; ++x) {
    for (int z = -across; z < across; ++z) {
      const glm::vec3 lower(float(x), -1, float(z));
      result.push_back({.box = {lower, lower + glm::vec3(1, 2, 1)}, .function = {}, .steepness = 3, .resolution = 96});
    }
  }
  return result;
}
// </region: land>

}  // namespace

int main() {
  const auto land = cells(5);
  const glint::Bvh geometry{glint::Elements{land}};

  using Light = glint::OneOf<glint::DirectionalLight, glint::ConstantEnvironment>;
  const glint::Lights<Light> lights{
      {glint::DirectionalLight{{-1, -0.5F, 0.4F}, {2.4F, 2, 1.5F}}, glint::ConstantEnvironment{{0.35F, 0.45F, 0.6F}}}};
  const glint::Scene scene{geometry, glint::Lambertian{{0.45F, 0.4F, 0.3F}}, lights,
                           glint::choose_by<glint::UniformLightSampler>};
  glint::Film film{{192, 108}};
  glint::render(scene, glint::Perspective{.eye = {-2, 1.6F, 7}, .target = {0, -0.4F, 0}}, glint::Direct{}, film,
                {.samples = 16});
  glint::write_png(film.develop(), "terrain.png");

  int hits = 0;
  int wrong = 0;
  for (int x = 0; x < 40; ++x) {
    for (int z = 0; z < 25; ++z) {  // from above: down to the first ground, and not through it
      const glint::Ray<float> ray{.origin = {float(x) * 0.2F - 4, 3, float(z) * 0.3F - 4}, .direction = {0, -1, 0}};
      const auto hit = geometry.closest(ray);
      if (!hit) continue;
      ++hits;
      if (std::abs(Land{}(ray.at(hit->t))) > 1e-4F || Land{}(ray.at(hit->t - 0.05F)) < 0) ++wrong;
    }
  }
  std::printf("%zu cells; of 1000 rays from above %d meet the ground, %d of them not at its surface\n", land.size(),
              hits, wrong);
  return hits > 900 && wrong <= hits / 100 ? 0 : 1;  // a ledge thinner than the walk's least step may be missed
}

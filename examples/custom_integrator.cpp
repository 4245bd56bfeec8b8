// SPDX-License-Identifier: MIT
// An integrator of one's own in ten lines: how open each place is to its surroundings. Writes openness.png.
#include <cmath>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/io/image.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>
#include <glint/render/render.hpp>
#include <glint/sampler/stratified.hpp>
#include <glint/scene/scene.hpp>

// <region: integrator>
struct Openness {
  float reach = 1;  ///< how far the surroundings go

  template <glint::SceneLike S, glint::Sampler R>
  glint::Rgb radiance(const S& scene, const glint::Ray<float>& ray, R& sampler) const {
    const auto at = scene.interact(ray);
    if (!at) return 1;
    const auto direction = at->to_world(glint::cosine_hemisphere(sampler.next_2d()));
    auto probe = at->leave(direction);
    probe.t_max = reach;
    return scene.occluded(probe) ? 0 : 1;
  }
};
// </region: integrator>

int main() {
  std::vector<glint::Sphere<float>> pebbles;
  glint::Random random(7);
  for (int i = 0; i < 300; ++i) {
    const float radius = random.uniform(0.08F, 0.35F);
    const float x = random.uniform(-4.0F, 4.0F);
    const float z = random.uniform(-4.0F, 4.0F);
    pebbles.push_back({{x, 0.7F * radius, z}, radius});
  }
  const std::vector<glint::Quad<float>> floor{{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}};

  // <region: render>
  const glint::Scene scene{glint::Bvh{glint::Joined{glint::Elements{pebbles}, glint::Elements{floor}}}};
  const glint::Perspective camera{.eye = {0, 3, 5.5F}, .target = {0, 0, 0.3F}};
  glint::Film film{{320, 200}, glint::TentFilter{}};
  glint::render(scene, camera, Openness{.reach = 1}, film, {.samples = 32}, glint::Serial{},
                glint::Stratified{.samples_per_pixel = 32});
  glint::write_png(film.develop(), "openness.png");
  // </region: render>
}

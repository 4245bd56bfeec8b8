// SPDX-License-Identifier: MIT
// A primitive and an integrator of one's own, rendered under a bright sky: writes ellipsoids.exr and ellipsoids.png.
#include <cstdio>
#include <string>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/io/image.hpp>
#include <glint/light/environment.hpp>
#include <glint/render/render.hpp>
#include <glint/scene/scene.hpp>
#include <glint/testing/primitive_laws.hpp>

// <region: primitive>
struct Ellipsoid {  // a primitive …
  glm::vec3 center{0};
  glm::vec3 radii{1};
};
glint::Aabb<float> bounds(const Ellipsoid& e) {
  return {e.center - e.radii, e.center + e.radii};
}
auto intersect(const glint::Ray<float>& ray, const Ellipsoid& e) {  // … its intersector …
  const glint::Ray<float> local{(ray.origin - e.center) / e.radii, ray.direction / e.radii, ray.t_min, ray.t_max};
  return intersect(local, glint::Sphere<float>{.radius = 1});  // t is the same in both spaces
}
glint::Surface surface(const Ellipsoid& e, const glint::Vec3<float>& p) {  // … and its shading data
  return {.position = p, .normal = glm::normalize((p - e.center) / (e.radii * e.radii))};
}
// </region: primitive>

// <region: integrator>
struct OneBounce {
  template <glint::SceneLike S, glint::Sampler R>
  glint::Rgb radiance(const S& scene, const glint::Ray<float>& ray, R& sampler) const {
    const auto at = scene.interact(ray);
    if (!at) return scene.background(ray.direction);
    const float lobe = sampler.next_1d();  // one draw a statement: the order is then the same for every compiler
    const auto scattered = at->bsdf.sample(at->to_local(at->wo), lobe, sampler.next_2d());
    if (!scattered) return 0;
    const auto next = at->leave(at->to_world(scattered->wi));
    return scene.occluded(next) ? 0 : scattered->weight * scene.background(next.direction);
  }
};
// </region: integrator>

int main() {
  // <region: render>
  const std::vector<Ellipsoid> shapes{{{0, 0, 0}, {1, 2, 1}}, {{2.5F, -1.4F, 1}, {1.2F, 0.6F, 1.5F}}};
  const std::vector<glint::Quad<float>> floor{{{-20, -2, 20}, {40, 0, 0}, {0, 0, -40}}};
  const glint::Bvh geometry{glint::Joined{glint::Elements{shapes}, glint::Elements{floor}}};
  const glint::Scene scene{geometry, glint::Lambertian{{0.8F, 0.6F, 0.4F}},
                           glint::ConstantEnvironment{{0.8F, 0.9F, 1.0F}}};
  glint::Film film{{256, 192}};
  glint::render(scene, glint::Perspective{.eye = {3, 2, 9}, .target = {1, 0, 0}}, OneBounce{}, film, {.samples = 32});
  glint::write_exr(film.develop(), "ellipsoids.exr");
  glint::write_png(film.develop(), "ellipsoids.png");
  // </region: render>

  // <region: laws>
  const auto broken = glint::testing::violations_of_primitive_laws(shapes[1], 1);
  for (const std::string& law : broken) std::puts(law.c_str());
  return broken.empty() ? 0 : 1;
  // </region: laws>
}

// SPDX-License-Identifier: MIT
// Parts of one's own, held to the library's laws: a sound set, query, BSDF and light, and a primitive with a mistake.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bvh/query/ray.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/environment.hpp>
#include <glint/testing/bsdf_laws.hpp>
#include <glint/testing/light_laws.hpp>
#include <glint/testing/primitive_laws.hpp>
#include <glint/testing/query_laws.hpp>
#include <glint/testing/set_laws.hpp>

using glint::Aabb, glint::Ray;

// <region: mistake>
/// A ball whose box was worked out from the wrong end: the lower corner is a tenth too high.
struct Ball {
  glint::Sphere<float> sphere;
};
Aabb<float> bounds(const Ball& ball) {
  const Aabb<float> box = bounds(ball.sphere);
  return {box.lower + 0.1F * glint::extent(box), box.upper};
}
auto intersect(const Ray<float>& ray, const Ball& ball) {
  return intersect(ray, ball.sphere);
}
// </region: mistake>

/// Prints what is broken, and says how much that was.
std::size_t report(const char* what, const std::vector<std::string>& broken) {
  std::printf("%s: %zu broken\n", what, broken.size());
  for (const std::string& sentence : broken) std::printf("  %s\n", sentence.c_str());
  return broken.size();
}

int main() {
  namespace laws = glint::testing;
  std::size_t broken = 0;
  // <region: sound>
  const std::vector<glint::Sphere<float>> spheres{{{0, 0, 0}, 1}, {{2, 0, 0}, 0.5F}};
  const glint::Elements set{spheres};
  broken += report("set", laws::violations_of_set_laws(set, 1));

  const Aabb<float> box{{-1, -1, -1}, {1, 1, 1}};
  const Ray<float> ray{.origin = {-2, 0.1F, 0}, .direction = {1, 0, 0.1F}};
  const glint::RayQuery<float, 8, glint::RayOrder::NearestFirst> query(ray, glint::RayReach<float>::of(box));
  broken += report("query", laws::violations_of_query_laws<8>(query, box, 1));

  const glint::Lambertian bsdf{{0.8F, 0.5F, 0.2F}};
  broken += report("BSDF", laws::violations_of_bsdf_laws(bsdf, 1, {.seen_from = laws::SeenFrom::Front}));

  const glint::ConstantEnvironment light{{1, 2, 3}};
  broken += report("light", laws::violations_of_light_laws(light, {0, 0, 0}, 1));
  // </region: sound>

  // <region: found>
  const std::size_t found = report("ball", laws::violations_of_primitive_laws(Ball{spheres[0]}, 1));
  // </region: found>
  return broken == 0 && found > 0 ? 0 : 1;
}

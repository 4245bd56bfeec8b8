// SPDX-License-Identifier: MIT
// A user's own shape, traced through the installed headers.
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

struct Ellipsoid {
  glm::vec3 center, radii;
};

glint::Aabb<float> bounds(const Ellipsoid& e) {
  return {e.center - e.radii, e.center + e.radii};
}

auto intersect(const glint::Ray<float>& ray, const Ellipsoid& e) {
  const glint::Ray<float> local{(ray.origin - e.center) / e.radii, ray.direction / e.radii, ray.t_min, ray.t_max};
  return intersect(local, glint::Sphere<float>{});
}

int main() {
  const std::vector<Ellipsoid> shapes{{{0, 0, 0}, {1, 2, 1}}, {{3, 0, 0}, {1, 1, 2}}};
  const glint::Bvh geometry{glint::Elements{shapes}};
  const auto hit = geometry.closest({.origin = {3, 0, 9}, .direction = {0, 0, -1}});
  const bool right = hit && hit->primitive == 1 && hit->t == 7;  // the second reaches from z = −2 to z = 2
  return right && !geometry.occluded({.origin = {9, 9, 9}}) ? 0 : 1;
}

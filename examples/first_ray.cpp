// SPDX-License-Identifier: MIT
// One sphere, one ray: where they meet.
#include <cstdio>

#include <glint/geometry/ray.hpp>
#include <glint/geometry/sphere.hpp>

int main() {
  // <region: trace>
  const glint::Sphere<float> sphere{.center = {0, 0, -5}, .radius = 2};
  const glint::Ray<float> ray{.origin = {0, 0, 0}, .direction = {0, 0, -1}};

  const auto hit = intersect(ray, sphere);
  if (!hit) return 1;

  const glint::Surface at = surface(sphere, ray.at(hit->t));
  std::printf("hit at t = %g\n", hit->t);
  std::printf("position %g %g %g\n", at.position.x, at.position.y, at.position.z);
  std::printf("normal   %g %g %g\n", at.normal.x, at.normal.y, at.normal.z);
  // </region: trace>
}

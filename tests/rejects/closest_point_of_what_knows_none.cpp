// SPDX-License-Identifier: MIT
// Says: (ClosestPointSet|constraints not satisfied|no matching function for call to 'closest_point')
// Closest points need primitives that know theirs; a shape with `bounds` and `intersect` alone can only be hit.
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

struct Bubble {
  glint::Sphere<float> sphere{};
};
inline glint::Aabb<float> bounds(const Bubble& bubble) {
  return bounds(bubble.sphere);
}
inline auto intersect(const glint::Ray<float>& ray, const Bubble& bubble) {
  return intersect(ray, bubble.sphere);
}

const std::vector<glint::Sphere<float>> spheres(1);
const std::vector<Bubble> bubbles(1);
const auto of_spheres = closest_point(glint::Bvh{glint::Elements{spheres}}, {0, 0, 0});
#ifdef REJECTED
const auto of_bubbles = closest_point(glint::Bvh{glint::Elements{bubbles}}, {0, 0, 0});
#endif

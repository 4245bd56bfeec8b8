// SPDX-License-Identifier: MIT
// Says: Primitive
// A shape that forgot its `intersect` is named as no Primitive, at the line that uses it.
#include <vector>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

struct Cloud {};
inline glint::Aabb<float> bounds(const Cloud&) {
  return {};
}

const std::vector<glint::Sphere<float>> spheres;
const std::vector<Cloud> clouds;
glint::Elements set_of_spheres{spheres};
#ifdef REJECTED
glint::Elements set_of_clouds{clouds};
#endif

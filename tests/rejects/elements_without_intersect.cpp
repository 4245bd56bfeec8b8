// SPDX-License-Identifier: MIT
// Says: (Primitive|constraints not satisfied for class template 'Elements')
// A shape that forgot its `intersect` is refused at the line that uses it; GCC names the concept, Clang the class.
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

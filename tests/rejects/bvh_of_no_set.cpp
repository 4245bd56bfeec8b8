// SPDX-License-Identifier: MIT
// Says: (BoundedSet|PrimitiveSet|constraints not satisfied for class template 'Bvh')
// A tree stands over a set of primitives. A bare vector of them is not one: `Elements` makes it one.
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>

const std::vector<glint::Sphere<float>> spheres(3);
glint::Bvh over_a_set{glint::Elements{spheres}};
#ifdef REJECTED
glint::Bvh over_a_vector{spheres};
#endif

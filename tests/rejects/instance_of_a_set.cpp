// SPDX-License-Identifier: MIT
// Says: (Placeable|constraints not satisfied|no matching function for call to 'place')
// What is placed is a tree, not the set it stands over: rays have to find their way in it.
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/sphere.hpp>

const std::vector<glint::Sphere<float>> spheres(1);
const glint::Elements set{spheres};
const glint::Bvh tree{set};
const auto placed_tree = place(tree, glint::Affine<float>{});
#ifdef REJECTED
const auto placed_set = place(set, glint::Affine<float>{});
#endif

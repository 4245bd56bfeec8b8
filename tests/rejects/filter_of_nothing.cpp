// SPDX-License-Identifier: MIT
// Says: (HitFilter|constraints not satisfied|no viable constructor)
// A filter says yes or no to a hit on a ray; what takes anything else is refused where it is named.
#include <vector>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/sphere.hpp>

const std::vector<glint::Sphere<float>> spheres;
glint::Filtered by_hit{glint::Elements{spheres}, [](const auto&, const auto& hit) { return hit.t > 1; }};
#ifdef REJECTED
glint::Filtered by_index{glint::Elements{spheres}, [](int index) { return index > 1; }};
#endif

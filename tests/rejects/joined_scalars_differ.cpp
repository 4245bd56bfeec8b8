// SPDX-License-Identifier: MIT
// Says: Joined sets must have the same scalar type
// A tree is in float or in double; sets of both cannot share one.
#include <vector>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>

const std::vector<glint::Sphere<float>> coarse;
const std::vector<glint::Sphere<double>> fine;
glint::Joined alike{glint::Elements{fine}, glint::Elements{fine}};
#ifdef REJECTED
glint::Joined mixed{glint::Elements{coarse}, glint::Elements{fine}};
#endif

// SPDX-License-Identifier: MIT
// Says: floating_point
// Rays, boxes and hits are made of floating-point numbers.
#include <glint/geometry/ray.hpp>

glint::Ray<double> ray;
#ifdef REJECTED
glint::Ray<int> integers;
#endif

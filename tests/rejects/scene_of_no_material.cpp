// SPDX-License-Identifier: MIT
// Says: (Material|constraints not satisfied|no viable constructor)
// A color is no material: what surfaces are made of says how they scatter light.
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/scene/scene.hpp>

const std::vector<glint::Sphere<float>> spheres;
const glint::Scene gray{glint::Bvh{glint::Elements{spheres}}, glint::Lambertian{0.5F}};
#ifdef REJECTED
const glint::Scene bare{glint::Bvh{glint::Elements{spheres}}, glint::Rgb{0.5F}};
#endif

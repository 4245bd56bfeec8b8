// SPDX-License-Identifier: MIT
// Says: (convert|conversion)
// Radiance and positions are different types, though both are three numbers.
#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

glint::Rgb radiance{1.0F};
#ifdef REJECTED
glint::Vec3<float> position = radiance;
#endif

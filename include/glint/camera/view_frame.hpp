// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include <glm/geometric.hpp>

#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The axes of a camera: x to the right of the image, y to its top, z backward, away from the target.
///
/// In double, since it is worked out once: eyes far from the origin and nearly parallel ups stay accurate.
///
/// Errors: where eye and target coincide the camera looks along −z. An `up` without direction, or parallel to the view
///         (to within a millionth), is replaced by −z, as on a map seen from above; by +y where the view is along z.
[[nodiscard]] inline Frame<double> view_frame(const Vec3<float>& eye, const Vec3<float>& target,
                                              const Vec3<float>& up) noexcept {
  const auto unit_or = [](const Vec3<double>& v, const Vec3<double>& otherwise) {
    const double squared = length_squared(v);
    return squared > 0 && std::isfinite(squared) ? v * (1 / std::sqrt(squared)) : otherwise;
  };
  const Vec3<double> minus_z{0.0, 0.0, -1.0};
  const Vec3<double> forward = unit_or(Vec3<double>(target) - Vec3<double>(eye), minus_z);
  Vec3<double> right{0.0};
  for (const Vec3<double>& candidate : {Vec3<double>(up), minus_z, Vec3<double>(0.0, 1.0, 0.0)}) {
    right = glm::cross(forward, unit_or(candidate, forward));
    if (length_squared(right) > 1e-12) break;
  }
  right = glm::normalize(right);
  return {right, glm::cross(right, forward), -forward};
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <optional>

#include <glint/geometry/offset.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

namespace glint::testing {

/// The oracle for crossings: where along a ray, t in [0, t_max], a function of points changes its sign for the first
/// time, by small steps and bisection in double precision.
template <typename Function>
[[nodiscard]] std::optional<double> first_sign_change(const Ray<double>& ray, double t_max, const Function& function) {
  constexpr int steps = 4000;
  double before = 0;
  const bool is_inside = function(ray.at(0)) < 0;
  for (int i = 1; i <= steps; ++i) {
    double after = t_max * i / steps;
    if ((function(ray.at(after)) < 0) == is_inside) {
      before = after;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = (before + after) / 2;
      ((function(ray.at(middle)) < 0) == is_inside ? before : after) = middle;
    }
    return after;
  }
  return std::nullopt;
}

/// How many of many rays that leave a closed convex surface to its outer side meet it again, and how many that leave to
/// its inner side do not. `from_u(u)` is the surface at a point of the unit square.
template <std::floating_point T, typename P, typename FromU>
[[nodiscard]] int count_wrong_departures(const P& primitive, const FromU& from_u) {
  Random random(21);
  int wrong = 0;
  for (int i = 0; i < 4000; ++i) {
    const SurfaceOf<T> at = from_u(random.uniform_vec2<T>());
    Vec3<T> direction = random.uniform_vec3<T>() * T(2) - T(1);
    if (glm::dot(direction, at.normal) < T(0)) direction = -direction;
    const auto out = spawn_ray(at, direction);
    const auto in = spawn_ray(at, -direction);
    if (intersect(out, primitive)) ++wrong;
    if (!intersect(in, primitive)) ++wrong;
  }
  return wrong;
}

}  // namespace glint::testing

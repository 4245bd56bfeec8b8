// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>

#include <glint/bsdf/concepts.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/frame.hpp>

namespace glint {

/// Where a ray meets the scene, and how light scatters there.
template <Bsdf B>
struct Interaction {
  Surface surface{};
  Frame<float> frame{};              ///< the shading frame: z is the shading normal
  Vec3<float> wo{0.0F, 0.0F, 1.0F};  ///< back along the ray, unit length, world space
  B bsdf{};
  std::uint64_t primitive = none<std::uint64_t>;  ///< the geometry's index
  std::uint32_t light = none<std::uint32_t>;      ///< the light that stands on this primitive

  [[nodiscard]] Vec3<float> to_local(const Vec3<float>& direction) const noexcept { return frame.to_local(direction); }
  [[nodiscard]] Vec3<float> to_world(const Vec3<float>& direction) const noexcept { return frame.to_world(direction); }

  /// The ray that leaves the surface in a world direction, and does not meet it again.
  [[nodiscard]] Ray<float> leave(const Vec3<float>& direction) const noexcept { return spawn_ray(surface, direction); }

  /// Turns a ray into that one, in place: copies of what was just written stall the processor.
  void leave(const Vec3<float>& direction, Ray<float>& ray) const noexcept {
    constexpr Ray<float> fresh;
    ray.origin = offset_origin(surface, direction);
    ray.direction = direction;
    ray.t_min = fresh.t_min;
    ray.t_max = fresh.t_max;
    ray.time = fresh.time;
    ray.mask = fresh.mask;
  }

  /// The ray from the surface to a point: t = 1 there.
  [[nodiscard]] Ray<float> leave_to(const Vec3<float>& target) const noexcept { return spawn_ray_to(surface, target); }
};

}  // namespace glint

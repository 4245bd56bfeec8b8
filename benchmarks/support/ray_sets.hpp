// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/math/warp.hpp>

#include <support/named_mesh.hpp>

/// Rays as renderers cast them.
namespace glint::bench {

using Rays = std::vector<Ray<float>>;

enum class Question { Closest, Occluded };

struct RaySet {
  std::string name;
  Question question = Question::Closest;
  Rays rays{};
};

[[nodiscard]] inline Viewpoint look_at_all(const Aabb<float>& box) {
  const Vec3<float> center = centroid(box);
  const float size = glm::length(extent(box));
  return {.eye = center + Vec3<float>{0.3F, 0.4F, 1.0F} * size,
          .target = center,
          .light = center + Vec3<float>{0.5F, 2.0F, 1.0F} * size,
          .half_width = 0.27F};
}

/// Casts a square image row by row, one jittered ray a pixel, and hands each to `use(ray)`.
template <typename Use>
void each_camera_ray(const Viewpoint& view, int side, const Use& use) {
  Random random(7);
  const Vec3<float> forward = glm::normalize(view.target - view.eye);
  const Vec3<float> right = glm::normalize(glm::cross(forward, Vec3<float>{0, 1, 0}));
  const Vec3<float> up = glm::cross(right, forward);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const float u = view.half_width * (2 * (float(x) + random.uniform<float>()) / float(side) - 1);
      const float v = view.half_width * (1 - 2 * (float(y) + random.uniform<float>()) / float(side));
      use(Ray<float>{.origin = view.eye, .direction = glm::normalize(forward + right * u + up * v)});
    }
  }
}

/// One ray on from each camera ray's hit, in their order, where `spawn(surface)` gives one. The image is made as fine
/// as it takes to have `count` of them.
template <typename Caster, typename Spawn>
[[nodiscard]] Rays rays_from_hits(const Caster& caster, const Viewpoint& view, std::size_t count, const Spawn& spawn) {
  double side = std::sqrt(double(count));
  for (int tries = 0;; ++tries) {
    Rays rays;
    each_camera_ray(view, int(side), [&](const Ray<float>& ray) {
      const auto hit = caster.closest(ray);
      if (!hit) return;
      SurfaceOf<float> at = caster.surface(ray, *hit);
      if (glm::dot(at.normal, ray.direction) > 0) at.normal = -at.normal;
      if (const std::optional<Ray<float>> next = spawn(at)) rays.push_back(*next);
    });
    if (rays.size() >= count || tries == 4) return rays;
    side = std::ceil(side * std::sqrt(1.02 * double(count) / double(rays.size() + count / 16))) + 1;
  }
}

/// At least `count` rays of each kind, unless a mesh is hardly hit at all: from a camera, on from what they hit in all
/// directions, as far or less far, and to a point light.
template <typename Caster>
[[nodiscard]] std::vector<RaySet> ray_sets(const Caster& caster, const Viewpoint& view, std::size_t count) {
  std::vector<RaySet> sets{{.name = "primary"}};
  const int side = int(std::ceil(std::sqrt(double(count))));
  each_camera_ray(view, side, [&](const Ray<float>& ray) { sets[0].rays.push_back(ray); });
  Random random(11);
  const auto bounce = [&](const SurfaceOf<float>& at) {
    const auto u = random.uniform<float>();
    const auto v = random.uniform<float>();
    return std::optional(spawn_ray(at, Frame<float>::around(at.normal).to_world(cosine_hemisphere(Vec2<float>{u, v}))));
  };
  const float reach = 0.1F * glm::length(extent(caster.bounds()));
  const auto look_around = [&](const SurfaceOf<float>& at) {
    auto ray = bounce(at);
    ray->t_max = reach;
    return ray;
  };
  const auto to_light = [&](const SurfaceOf<float>& at) -> std::optional<Ray<float>> {
    if (glm::dot(at.normal, view.light - at.position) <= 0) return std::nullopt;
    return spawn_ray_to(at, view.light);
  };
  sets.push_back({"diffuse", Question::Closest, rays_from_hits(caster, view, count, bounce)});
  sets.push_back({"ao", Question::Occluded, rays_from_hits(caster, view, count, look_around)});
  sets.push_back({"shadow", Question::Occluded, rays_from_hits(caster, view, count, to_light)});
  return sets;
}

}  // namespace glint::bench

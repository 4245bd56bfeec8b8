// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_differential.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/vec.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/interaction.hpp>

namespace glint {

/// What a path carries through scenes that filter no textures: nothing.
struct NoFootprint {
  template <Bsdf B>
  void scatter(const Interaction<B>& /*at*/, const BsdfSample& /*scattered*/,
               const Vec3<float>& /*direction*/) const noexcept {}
};

/// How wide a path is: the neighborhood that it stands for on the surfaces it meets, so that textures can be filtered.
///
/// It starts as the camera's ray differential. A specular bounce turns that as the flat mirror would that throws the
/// ray the same way: exact for flat mirrors, without the widening by curvature and refraction elsewhere. Any other
/// bounce makes a cone of it, as wide as before and by the directions that the sample stands for: 1 / pdf, shared by
/// `paths_a_lobe`.
///
/// Source: Igehy, "Tracing Ray Differentials", SIGGRAPH 1999; Akenine-Möller et al., "Texture Level of Detail
///         Strategies for Real-Time Ray Tracing", Ray Tracing Gems (2019), ch. 20, for cones; Colbert, Křivánek,
///         "GPU-Based Importance Sampling", GPU Gems 3 (2007), section 20.4, for the width by density.
class PathFootprint {
 public:
  /// Of how many paths each sampled direction is thought to be one: textures seen by a lobe of standard deviation σ are
  /// blurred by about σ/4 more.
  static constexpr float paths_a_lobe = 16;

  /// A path that stands for itself alone: textures are not filtered, and nothing is worked out.
  PathFootprint() = default;
  explicit PathFootprint(const RayDifferential& differential) : differential_(differential), is_thin_(false) {}

  [[nodiscard]] bool is_thin() const noexcept { return is_thin_; }
  [[nodiscard]] const RayDifferential& differential() const noexcept { return differential_; }

  /// Goes on in a direction sampled where the path is. Requires: `direction` is the sample's, in the world.
  template <Bsdf B>
  void scatter(const Interaction<B>& at, const BsdfSample& scattered, const Vec3<float>& direction) noexcept {
    if (is_thin_) return;
    differential_.origin_x = at.surface.footprint.x;
    differential_.origin_y = at.surface.footprint.y;
    if (scattered.lobe == Lobe::Specular) {
      turn(-at.wo, direction);
    } else {
      widen(scattered.pdf, direction);
    }
  }

 private:
  /// Householder's reflection that takes one direction to another.
  void turn(const Vec3<float>& from, const Vec3<float>& to) noexcept {
    const Vec3<float> normal = to - from;
    const float squared = length_squared(normal);
    if (!(squared > 1e-12F)) return;
    const auto mirrored = [&](const Vec3<float>& v) { return v - normal * (2 * glm::dot(normal, v) / squared); };
    differential_.direction_x = mirrored(differential_.direction_x);
    differential_.direction_y = mirrored(differential_.direction_y);
  }

  /// No wider than a steradian.
  void widen(float pdf, const Vec3<float>& direction) noexcept {
    const Vec3<float> before = glm::cross(differential_.direction_x, differential_.direction_y);
    const float solid_angle = std::sqrt(length_squared(before)) + 1 / (paths_a_lobe * pdf);
    const float side = std::sqrt(std::min(1.0F, solid_angle));
    const Frame<float> frame = Frame<float>::around(direction);
    differential_.direction_x = frame.x * side;
    differential_.direction_y = frame.y * side;
  }

  RayDifferential differential_{};
  bool is_thin_ = true;
};

/// A scene whose textures ask how wide paths are: `interact(ray, footprint)`.
template <typename S>
concept FilteringScene = SceneLike<S> && S::asks_for_footprints &&
    requires(const S& scene, const Ray<float>& ray, const PathFootprint& footprint) {
  scene.interact(ray, footprint).has_value();
};

/// The closest surface on a path's ray; with the path's footprint there, where the path has one and the scene asks.
template <SceneLike S>
[[nodiscard]] auto interact(const S& scene, const Ray<float>& ray, const NoFootprint& /*footprint*/) {
  return scene.interact(ray);
}
template <SceneLike S>
[[nodiscard]] auto interact(const S& scene, const Ray<float>& ray, const PathFootprint& footprint) {
  if constexpr (FilteringScene<S>) {
    return scene.interact(ray, footprint);
  } else {
    return scene.interact(ray);
  }
}

}  // namespace glint

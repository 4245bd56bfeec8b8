// SPDX-License-Identifier: MIT
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/math/random.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// Surfaces that light passes, straight on, as far as textures say: leaves, gauze, smoke on a pane. A filter for
/// `Filtered`: a hit counts with a chance of the opacity there, the luminance of a texture. All rays obey it, those
/// that ask for shadow too, so that every integrator renders such surfaces and none has to know of them.
///
///     const glint::Opacity opacity{mesh, std::span{textures}, std::span{of_primitive}};
///     const glint::Bvh bvh{glint::Filtered{mesh, opacity}};
///
/// The chance is a hash of the ray, the primitive and the side that is seen: one ray meets the same surfaces whenever
/// it is asked, in any tree and for closest hits as for occlusion, and rays that differ are independent. What is found
/// for a ray is right on the mean over rays, as a pixel's are; opacities of 0 and 1 make no noise.
///
/// Where light passes no segment of a path ends. Next-event estimation looks at the light alone and not at what covers
/// it: primitives that shine should be opaque.
///
/// Shapes:   of_primitive[i] is an index into the textures, none<std::uint32_t> for opaque primitives.
/// Requires: one entry for each primitive; all that is viewed outlives the filter.
/// Errors:   a luminance of one or more is opaque, one of zero or less, or NaN, lets all light pass.
/// Cost:     for opaque primitives a look into of_primitive; for others the texture and, for partial opacity, a hash.
/// Source:   the hash in place of a stored random number: Pharr, Jakob, Humphreys, Physically Based Rendering (2023),
///           section 7.1.1.
template <ShadableSet S, ShadingTexture T>
class Opacity {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  Opacity(S set, std::span<const T> textures, std::span<const std::uint32_t> of_primitive)
      : set_(std::move(set)), textures_(textures), of_primitive_(of_primitive) {}

  [[nodiscard]] bool operator()(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const {
    GLINT_ASSERT(hit.primitive < of_primitive_.size());
    const std::uint32_t texture = of_primitive_[hit.primitive];
    return texture == none<std::uint32_t> || covers(textures_[texture], ray, hit);
  }

 private:
  [[nodiscard]] bool covers(const T& texture, const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const {
    const Surface at = surface_at(ray, hit);
    const float opacity = luminance(color_at(texture, at));
    if (opacity >= 1.0F) return true;
    if (!(opacity > 0.0F)) return false;
    return chance(ray, hit, glm::dot(at.normal, Vec3<float>(ray.direction)) < 0.0F) < opacity;
  }

  [[nodiscard]] Surface surface_at(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const {
    if constexpr (std::is_same_v<Scalar, float>) {
      return set_.surface(ray, hit);
    } else {
      return surface_cast<float>(set_.surface(ray, hit));
    }
  }

  /// Uniform in [0, 1). Of the ray its line alone, since the interval may have been shortened.
  [[nodiscard]] static float chance(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit, bool from_front) noexcept {
    std::uint64_t state = 2 * static_cast<std::uint64_t>(hit.primitive) + (from_front ? 1U : 0U);
    for (const Scalar x :
         {ray.origin.x, ray.origin.y, ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z, ray.time}) {
      state = mix(state, std::bit_cast<std::uint64_t>(static_cast<double>(x)));
    }
    return to_unit_float<float>(static_cast<std::uint32_t>(state >> 32U));
  }

  S set_;
  std::span<const T> textures_;
  std::span<const std::uint32_t> of_primitive_;
};

template <ShadableSet S, ShadingTexture T>
Opacity(S, std::span<const T>, std::span<const std::uint32_t>) -> Opacity<S, T>;

}  // namespace glint

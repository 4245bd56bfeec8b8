// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/offset.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>

namespace glint {

/// A shape that can be sampled uniformly by area: the library's primitives, or a set of triangles (TriangleSampler).
template <typename S>
concept AreaSampleable = requires(const S& shape, const Vec2<float>& u) {
  { area(shape) } -> std::same_as<float>;
  { sample_area(shape, u) } -> std::same_as<AreaSample<float>>;
};

/// A surface that gives off the same radiance everywhere and in every direction of its normal's side.
///
/// Units:    radiance in W/(m² sr).
/// Requires: the shape's area > 0.
template <AreaSampleable Shape>
struct AreaLight {
  Shape shape;
  Rgb radiance{1};

  /// A point on the surface, uniformly by area; nothing where it turns its back to `from`.
  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& u) const noexcept {
    const AreaSample<float> chosen = sample_area(shape, u);
    const Vec3<float> to_light = chosen.surface.position - from;
    const float squared = length_squared(to_light);
    const float facing = -glm::dot(to_light, chosen.surface.normal);
    if (!(facing > 0)) return std::nullopt;
    const float distance = std::sqrt(squared);
    return LightSample{.wi = to_light / distance,
                       .distance = distance,
                       .radiance = radiance,
                       .pdf = chosen.pdf * squared * distance / facing,
                       .target = offset_toward(chosen.surface, from)};
  }

  [[nodiscard]] Rgb emission(const Surface& at, const Vec3<float>& wo) const noexcept {
    return glm::dot(at.normal, wo) > 0 ? radiance : Rgb{};
  }

  /// The density of `sample` in solid angle: 1 / area · distance² / cosine.
  [[nodiscard]] float pdf(const Vec3<float>& from, const Surface& at) const noexcept {
    const Vec3<float> to_light = at.position - from;
    const float squared = length_squared(to_light);
    const float facing = -glm::dot(to_light, at.normal);
    return facing > 0 ? squared * std::sqrt(squared) / (facing * area(shape)) : 0;
  }

  [[nodiscard]] Rgb power(const Aabb<float>& /*scene*/) const noexcept { return radiance * (pi<float> * area(shape)); }

  [[nodiscard]] friend bool operator==(const AreaLight&, const AreaLight&) = default;
};

template <AreaSampleable Shape>
AreaLight(Shape, Rgb) -> AreaLight<Shape>;

}  // namespace glint

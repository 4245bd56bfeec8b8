// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/disk.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
#include <glint/light/light_bounds.hpp>
#include <glint/light/seen_quad.hpp>
#include <glint/light/seen_sphere.hpp>
#include <glint/light/seen_triangle.hpp>
#include <glint/light/solid_angle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/frame.hpp>
#include <glint/math/warp.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// Whether all of a shape has one normal, which makes for narrow LightBounds. Specialize it for your own.
template <typename S>
inline constexpr bool is_flat = false;
template <>
inline constexpr bool is_flat<Disk<float>> = true;
template <>
inline constexpr bool is_flat<Quad<float>> = true;
template <>
inline constexpr bool is_flat<Triangle<float>> = true;

namespace detail {

/// The mean of a texture over uv, by a grid of points. Not quite black, for light may hide between the points.
template <Texture T>
[[nodiscard]] Rgb mean_radiance(const T& texture) {
  constexpr int points = 64;
  Rgb sum;
  for (int y = 0; y < points; ++y) {
    for (int x = 0; x < points; ++x) {
      sum += texture.evaluate((Vec2<float>(static_cast<float>(x), static_cast<float>(y)) + 0.5F) / float(points));
    }
  }
  const Rgb mean = sum / float(points * points);
  return {std::max(mean.r, 1e-6F), std::max(mean.g, 1e-6F), std::max(mean.b, 1e-6F)};
}
[[nodiscard]] inline Rgb mean_radiance(const Rgb& radiance) noexcept {
  return radiance;
}

}  // namespace detail

/// A surface that shines on its normal's side, alike in every direction: everywhere with the same radiance, or as much
/// as a texture says at its uv.
///
/// Points on it are chosen by solid angle where the shape can do that (SeenSampleable), else by area.
///
/// Units:    radiance in W/(m² sr).
/// Requires: the shape's area > 0.
template <AreaSampleable Shape, typename Radiance = Rgb>
  requires(std::same_as<Radiance, Rgb> || Texture<Radiance>)
struct AreaLight {
  Shape shape;
  Radiance radiance{1};

  /// A point on the surface; nothing where it turns its back to `from`.
  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& from, const Vec2<float>& u) const noexcept {
    std::optional<LightSample> result;
    const std::optional<SeenSample> chosen = seen(from, u);
    if (!chosen) return result;
    const Vec3<float> to_light = chosen->surface.position - from;
    const float distance = glm::length(to_light);
    if (!(distance > 0)) return result;
    LightSample& sample = result.emplace();  // filled in place: copies of what was just written stall the processor
    sample.wi = to_light / distance;
    sample.distance = distance;
    sample.radiance = radiance_at(chosen->surface.uv);
    sample.pdf = chosen->pdf;
    sample.target = offset_toward(chosen->surface, from);
    sample.normal = chosen->surface.normal;
    return result;
  }

  [[nodiscard]] Rgb emission(const Surface& at, const Vec3<float>& wo) const noexcept {
    return glm::dot(at.normal, wo) > 0 ? radiance_at(at.uv) : Rgb{};
  }

  /// The density of `sample`.
  [[nodiscard]] float pdf(const Vec3<float>& from, const Surface& at) const noexcept {
    if (!(glm::dot(from - at.position, at.normal) > 0)) return 0;
    if constexpr (SeenSampleable<Shape>) return seen_pdf(shape, from, at);
    return seen_area_pdf(1 / area(shape), from, at);
  }

  [[nodiscard]] Rgb power(const Aabb<float>& /*scene*/) const {
    return detail::mean_radiance(radiance) * (pi<float> * area(shape));
  }

  [[nodiscard]] LightBounds light_bounds() const requires(requires(const Shape& s) { bounds(s); }) {
    LightBounds result{.box = bounds(shape), .intensity = luminance(detail::mean_radiance(radiance)) * area(shape)};
    if constexpr (is_flat<Shape>) {
      result.axis = sample_area(shape, Vec2<float>(0.5F)).surface.normal;
      result.cos_theta_o = 1;
    }
    return result;
  }

  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction,
                                               const Aabb<float>& /*scene*/) const noexcept {
    const AreaSample<float> from = sample_area(shape, u_position);
    const Vec3<float> local = cosine_hemisphere(u_direction);
    if (!(local.z > 0)) return std::nullopt;
    const Vec3<float> direction = Frame<float>::around(from.surface.normal).to_world(local);
    return EmittedRay{.ray = spawn_ray(from.surface, direction),
                      .radiance = radiance_at(from.surface.uv),
                      .normal = from.surface.normal,
                      .pdf = {from.pdf, cosine_hemisphere_pdf(local.z)}};
  }
  [[nodiscard]] EmissionPdf emission_pdf(const Surface& at, const Vec3<float>& direction,
                                         const Aabb<float>& /*scene*/) const noexcept {
    return {1 / area(shape), cosine_hemisphere_pdf(glm::dot(at.normal, direction))};
  }

  [[nodiscard]] friend bool operator==(const AreaLight&, const AreaLight&) = default;

 private:
  [[nodiscard]] std::optional<SeenSample> seen(const Vec3<float>& from, const Vec2<float>& u) const noexcept {
    if constexpr (SeenSampleable<Shape>) return sample_seen(shape, from, u);
    return sample_seen_by_area(shape, from, u);
  }

  [[nodiscard]] Rgb radiance_at(const Vec2<float>& uv) const noexcept {
    if constexpr (std::same_as<Radiance, Rgb>) {
      return radiance;
    } else {
      return radiance.evaluate(uv);
    }
  }
};

template <AreaSampleable Shape, typename Radiance>
AreaLight(Shape, Radiance) -> AreaLight<Shape, Radiance>;

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/geometry/surface.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A shape that can be sampled uniformly by area: the library's primitives, or a set of triangles (TriangleSampler).
template <typename S>
concept AreaSampleable = requires(const S& shape, const Vec2<float>& u) {
  { area(shape) } -> std::same_as<float>;
  { sample_area(shape, u) } -> std::same_as<AreaSample<float>>;
};

/// A point of a surface chosen as seen from somewhere.
struct SeenSample {
  Surface surface{};
  float pdf = 0;  ///< 1/sr
};

/// A shape that knows how to choose a point as seen from another, better than by area: by two functions found by ADL,
///
///     std::optional<SeenSample> sample_seen(const S& shape, const Vec3<float>& from, const Vec2<float>& u);
///     float seen_pdf(const S& shape, const Vec3<float>& from, const Surface& at);  // 1/sr, of sample_seen
///
/// Only what faces `from` is chosen.
template <typename S>
concept SeenSampleable = requires(const S& shape, const Vec3<float>& from, const Vec2<float>& u, const Surface& at) {
  { sample_seen(shape, from, u) } -> std::same_as<std::optional<SeenSample>>;
  { seen_pdf(shape, from, at) } -> std::same_as<float>;
};

/// A density by area, as seen from a point: distance² / cosine of it. Zero where the surface turns its back.
[[nodiscard]] inline float seen_area_pdf(float pdf, const Vec3<float>& from, const Surface& at) noexcept {
  const Vec3<float> to_surface = at.position - from;
  const float squared = length_squared(to_surface);
  const float facing = -glm::dot(to_surface, at.normal);
  return facing > 0 ? pdf * squared * std::sqrt(squared) / facing : 0;
}

/// A point chosen uniformly by area; nothing where the surface turns its back there.
template <AreaSampleable S>
[[nodiscard]] std::optional<SeenSample> sample_seen_by_area(const S& shape, const Vec3<float>& from,
                                                            const Vec2<float>& u) noexcept {
  std::optional<SeenSample> result;
  const AreaSample<float> chosen = sample_area(shape, u);
  const float pdf = seen_area_pdf(chosen.pdf, from, chosen.surface);
  if (!(pdf > 0)) return result;
  SeenSample& sample = result.emplace();
  sample.surface = chosen.surface;
  sample.pdf = pdf;
  return result;
}

}  // namespace glint

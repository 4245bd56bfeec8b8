// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <optional>

#include <glm/geometric.hpp>

#include <glint/core/one_of.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>

/// What a camera makes of light that reaches it: what paths from lights end with.
namespace glint {

/// A point as a camera sees it.
///
/// `importance` is the density with which the camera's rays, their film position uniform, find the point through this
/// part of the lens: per unit area that faces the camera, at the point. Light of intensity I (W/sr) toward the camera
/// adds I · importance to the film, measured so that the mean of that over as many light paths as there are pixels is
/// what a pixel's mean of radiances would be.
struct CameraSample {
  Vec2<float> film{0.0F};            ///< as in RayGenerator, in [0, 1)²
  Vec3<float> wi{0.0F, 0.0F, 1.0F};  ///< from the point toward the camera, unit length
  Vec3<float> target{0.0F};          ///< where on the lens: a shadow ray ends there
  float importance = 0;

  [[nodiscard]] friend bool operator==(const CameraSample&, const CameraSample&) noexcept = default;
};

/// A RayGenerator that can be asked the other way around, too:
///
///     std::optional<CameraSample> sample_toward(const Vec3<float>& point, const Vec2<float>& lens) const;
///     float importance(const Ray<float>& ray, float distance) const;   // of the point that far along one of its rays
///
/// `lens` is what ray() takes. Nothing where the point is not in the picture.
///
/// Laws: testing/camera_laws.hpp.
template <typename G>
concept ImportanceGenerator = requires(const G& generator, const Vec3<float>& point, const Vec2<float>& lens,
                                       const Ray<float>& ray, float distance) {
  { generator.sample_toward(point, lens) } -> std::same_as<std::optional<CameraSample>>;
  { generator.importance(ray, distance) } -> std::same_as<float>;
};

/// The two questions, asked of any camera's rays: nothing and zero where they have no answer.
template <typename G>
[[nodiscard]] std::optional<CameraSample> sample_toward(const G& generator, const Vec3<float>& point,
                                                        const Vec2<float>& lens) {
  if constexpr (ImportanceGenerator<G>) return generator.sample_toward(point, lens);
  return std::nullopt;
}
template <typename G>
[[nodiscard]] float importance(const G& generator, const Ray<float>& ray, float distance) {
  if constexpr (ImportanceGenerator<G>) return generator.importance(ray, distance);
  return 0;
}
template <typename... Ts>
[[nodiscard]] std::optional<CameraSample> sample_toward(const OneOf<Ts...>& generator, const Vec3<float>& point,
                                                        const Vec2<float>& lens) {
  return generator.visit([&](const auto& x) { return sample_toward(x, point, lens); });
}
template <typename... Ts>
[[nodiscard]] float importance(const OneOf<Ts...>& generator, const Ray<float>& ray, float distance) {
  return generator.visit([&](const auto& x) { return importance(x, ray, distance); });
}

/// True in the picture.
[[nodiscard]] inline bool is_on_film(const Vec2<float>& film) noexcept {
  return film.x >= 0 && film.x < 1 && film.y >= 0 && film.y < 1;
}

/// A rectangle that rays from one point pass through: film positions are uniform on it.
struct Window {
  Vec3<float> corner{-1.0F, -1.0F, -1.0F};  ///< from the point to its lower left corner
  Vec3<float> across{2.0F, 0.0F, 0.0F};     ///< its lower edge
  Vec3<float> upward{0.0F, 2.0F, 0.0F};     ///< its left edge, perpendicular to the lower

  /// The film position where a direction, of any length, passes through. Nothing where it does not.
  [[nodiscard]] std::optional<Vec2<float>> film(const Vec3<float>& direction) const noexcept {
    const float depth = glm::dot(direction, facing());
    if (!(depth > 0)) return std::nullopt;
    const Vec3<float> at = direction * (glm::dot(corner, facing()) / depth) - corner;
    const Vec2<float> film{glm::dot(at, across) / length_squared(across),
                           glm::dot(at, upward) / length_squared(upward)};
    return is_on_film(film) ? std::optional(film) : std::nullopt;
  }

  /// The importance of a point in a direction of unit length. With h the window's distance, A its area and θ the angle
  /// from its normal, h² / (A cos³ θ) is the density by solid angle; the edges' product has length A.
  [[nodiscard]] float importance(const Vec3<float>& direction, float distance) const noexcept {
    const float cosine = glm::dot(direction, facing());
    const float plane = glm::dot(corner, facing());
    return plane * plane / (cosine * cosine * cosine * distance * distance);
  }

 private:
  /// Away from the point, as long as the window's area.
  [[nodiscard]] Vec3<float> facing() const noexcept { return glm::cross(upward, across); }
};

/// A point as seen from another through a window.
[[nodiscard]] inline std::optional<CameraSample> seen_through(const Window& window, const Vec3<float>& from,
                                                              const Vec3<float>& point) noexcept {
  const Vec3<float> to_point = point - from;
  const auto film = window.film(to_point);
  if (!film) return std::nullopt;
  const float distance = glm::length(to_point);
  const Vec3<float> direction = to_point / distance;
  return CameraSample{*film, -direction, from, window.importance(direction, distance)};
}

}  // namespace glint

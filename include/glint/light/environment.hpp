// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <glm/matrix.hpp>

#include <glint/light/concepts.hpp>
#include <glint/light/emission.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/distribution.hpp>
#include <glint/math/spherical.hpp>
#include <glint/math/warp.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// The same radiance from every direction.
///
/// Units: radiance in W/(m² sr).
struct ConstantEnvironment {
  Rgb radiance{1};

  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& /*from*/, const Vec2<float>& u) const noexcept {
    return LightSample{
        .wi = uniform_sphere(u), .distance = infinity<float>, .radiance = radiance, .pdf = uniform_sphere_pdf<float>()};
  }

  [[nodiscard]] Rgb background(const Vec3<float>& /*direction*/) const noexcept { return radiance; }
  [[nodiscard]] static float pdf(const Vec3<float>& /*direction*/) noexcept { return uniform_sphere_pdf<float>(); }

  /// What falls on the sphere around the scene.
  [[nodiscard]] Rgb power(const Aabb<float>& scene) const noexcept {
    return radiance * (pi<float> * pi<float> * length_squared(is_empty(scene) ? Vec3<float>(0) : extent(scene)));
  }

  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction,
                                               const Aabb<float>& scene) const noexcept {
    const SceneDisk disk(scene);
    if (!(disk.radius > 0)) return std::nullopt;
    const Vec3<float> direction = uniform_sphere(u_direction);
    return EmittedRay{.ray = disk.ray(direction, u_position),
                      .radiance = radiance,
                      .normal = direction,
                      .pdf = {disk.pdf(), uniform_sphere_pdf<float>()}};
  }
  [[nodiscard]] static EmissionPdf emission_pdf(const Surface& /*at*/, const Vec3<float>& /*direction*/,
                                                const Aabb<float>& scene) noexcept {
    return {SceneDisk(scene).pdf(), uniform_sphere_pdf<float>()};
  }

  [[nodiscard]] friend bool operator==(const ConstantEnvironment&, const ConstantEnvironment&) noexcept = default;
};

static_assert(InfiniteLight<ConstantEnvironment> && EmittingLight<ConstantEnvironment>);

/// By what directions toward an environment are chosen.
enum class EnvironmentChoice : std::uint8_t {
  Radiance,     ///< in proportion to it: right for light sampling alone
  Compensated,  ///< in proportion to what exceeds the mean: less noise where BSDF sampling, weighted by the balance or
                ///< power heuristic, finds the rest. Directions of less than the mean are never chosen, nor are rays
                ///< emitted from there: alone, it is wrong
};

/// Radiance from infinitely far away, looked up in a texture by direction (math/spherical.hpp: y up, v = 0 at the
/// zenith, −z at u = 0), and sampled in proportion to it.
///
/// Source: Pharr, Jakob, Humphreys, Physically Based Rendering (4th ed., 2023), section 12.5.2; the compensated choice:
///         Karlík, Šik, Vévoda, Skřivan, Křivánek, "MIS Compensation: Optimizing Sampling Techniques in Multiple
///         Importance Sampling", ACM Transactions on Graphics 38(6), 2019.
template <Texture T>
class EnvironmentLight {
 public:
  /// `to_world` turns (or stretches) the texture's directions into the scene's. `resolution` is that of the table by
  /// which directions are chosen, best the image's own; it has no part in what the light looks like.
  ///
  /// Requires: to_world is invertible; resolution ≥ 1.
  EnvironmentLight(T texture, Vec2i resolution, Rgb scale = 1, const Mat3<float>& to_world = Mat3<float>(1),
                   EnvironmentChoice choice = EnvironmentChoice::Radiance)
      : texture_(std::move(texture)),
        scale_(scale),
        to_world_(to_world),
        from_world_(glm::inverse(to_world)),
        inverse_determinant_(1 / std::abs(glm::determinant(to_world))) {
    std::vector<float> cells = table(texture_, resolution);
    for (const float cell : cells) mean_ += static_cast<double>(cell) / static_cast<double>(cells.size());
    if (choice == EnvironmentChoice::Compensated) compensate(cells, resolution);
    choice_ = Distribution2D(cells, resolution.x, resolution.y);
  }

  [[nodiscard]] Rgb background(const Vec3<float>& direction) const {
    return scale_ * texture_.evaluate(direction_to_equirectangular(glm::normalize(from_world_ * direction)));
  }

  [[nodiscard]] std::optional<LightSample> sample(const Vec3<float>& /*from*/, const Vec2<float>& u) const {
    const auto chosen = choice_.sample(u);
    const Vec3<float> local = equirectangular_to_direction(chosen.point);
    const float density = solid_angle_pdf(chosen.pdf, local);
    if (!(density > 0)) return std::nullopt;
    return LightSample{.wi = glm::normalize(to_world_ * local),
                       .distance = infinity<float>,
                       .radiance = scale_ * texture_.evaluate(chosen.point),
                       .pdf = density};
  }

  [[nodiscard]] float pdf(const Vec3<float>& direction) const {
    const Vec3<float> local = glm::normalize(from_world_ * direction);
    return solid_angle_pdf(choice_.pdf(direction_to_equirectangular(local)), local);
  }

  [[nodiscard]] Rgb power(const Aabb<float>& scene) const {
    const float area = length_squared(is_empty(scene) ? Vec3<float>(0) : extent(scene));
    return scale_ * (pi<float> * pi<float> * static_cast<float>(mean_) * 0.5F * pi<float> * area);
  }

  [[nodiscard]] std::optional<EmittedRay> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction,
                                               const Aabb<float>& scene) const {
    const SceneDisk disk(scene);
    const auto toward = sample(disk.center, u_direction);
    if (!toward || !(disk.radius > 0)) return std::nullopt;
    return EmittedRay{.ray = disk.ray(-toward->wi, u_position),
                      .radiance = toward->radiance,
                      .normal = -toward->wi,
                      .pdf = {disk.pdf(), toward->pdf}};
  }
  [[nodiscard]] EmissionPdf emission_pdf(const Surface& /*at*/, const Vec3<float>& direction,
                                         const Aabb<float>& scene) const {
    return {SceneDisk(scene).pdf(), pdf(-direction)};
  }

 private:
  /// The mean luminance of a cell over nine points, borders included, so that no cell that shines anywhere under
  /// bilinear lookup gets zero.
  [[nodiscard]] static float cell_luminance(const T& texture, Vec2i cell, Vec2i resolution) {
    float sum = 0;
    for (const float y : {0.0F, 0.5F, 1.0F}) {
      for (const float x : {0.0F, 0.5F, 1.0F}) {
        sum += luminance(texture.evaluate((Vec2<float>(cell) + Vec2<float>{x, y}) / Vec2<float>(resolution)));
      }
    }
    return sum / 9;
  }

  /// A row's share of the sphere.
  [[nodiscard]] static float row_share(int y, Vec2i resolution) noexcept {
    return std::sin(pi<float> * (static_cast<float>(y) + 0.5F) / static_cast<float>(resolution.y));
  }

  /// The luminance of each cell times its share of the sphere.
  [[nodiscard]] static std::vector<float> table(const T& texture, Vec2i resolution) {
    std::vector<float> cells;
    cells.reserve(static_cast<std::size_t>(resolution.x) * static_cast<std::size_t>(resolution.y));
    for (int y = 0; y < resolution.y; ++y) {
      const float share = row_share(y, resolution);
      for (int x = 0; x < resolution.x; ++x) cells.push_back(cell_luminance(texture, {x, y}, resolution) * share);
    }
    return cells;
  }

  /// Takes the mean over the sphere off each cell. An even environment has nothing left: it stays as it is.
  static void compensate(std::vector<float>& cells, Vec2i resolution) {
    double shares = 0;
    double sum = 0;
    for (int y = 0; y < resolution.y; ++y) shares += static_cast<double>(row_share(y, resolution)) * resolution.x;
    for (const float cell : cells) sum += static_cast<double>(cell);
    const auto mean = static_cast<float>(sum / shares);
    std::vector<float> rest = cells;
    bool any = false;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      const float share = row_share(static_cast<int>(i / static_cast<std::size_t>(resolution.x)), resolution);
      rest[i] = std::max(0.0F, rest[i] - mean * share * (1 + rounding_bound<float>(64)));
      any = any || rest[i] > 0;
    }
    if (any) cells = std::move(rest);
  }

  /// From the unit square to the sphere, dω = 2π² sin θ du dv, and through the stretch of to_world.
  [[nodiscard]] float solid_angle_pdf(float pdf, const Vec3<float>& local) const {
    const float sine = std::sqrt(local.x * local.x + local.z * local.z);
    if (!(sine > 0)) return 0;
    const float stretch = glm::length(to_world_ * local);
    return pdf / (2 * pi<float> * pi<float> * sine) * stretch * stretch * stretch * inverse_determinant_;
  }

  T texture_;
  Rgb scale_{1};
  Mat3<float> to_world_{1.0F};
  Mat3<float> from_world_{1.0F};
  float inverse_determinant_ = 1;
  double mean_ = 0;  ///< of the cells, each of them luminance times share of the sphere
  Distribution2D choice_;
};

}  // namespace glint

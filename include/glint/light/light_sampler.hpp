// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glint/color/rgb.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/distribution.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// A light chosen among several.
struct ChosenLight {
  std::uint32_t index = 0;
  float probability = 0;

  [[nodiscard]] friend bool operator==(const ChosenLight&, const ChosenLight&) noexcept = default;
};

/// A way to choose one light among several, as seen from a surface:
///
///     std::optional<ChosenLight> choose(const Vec3<float>& from, const Vec3<float>& normal, float u) const;
///     float probability(const Vec3<float>& from, const Vec3<float>& normal, std::uint32_t light) const;
///
/// The normal is the one for shading, of unit length, and its side is of no meaning, for light may shine through; zero
/// where there is no surface. Nothing is chosen where no light reaches. Scenes build it from the lights and the scene's
/// bounds: `S(std::span<const L>, const Aabb<float>&)`.
///
/// Laws: a light is chosen as often as its probability says; every light that reaches `from` has one above zero.
template <typename S>
concept LightSampler = requires(const S& sampler, const Vec3<float>& v, float u, std::uint32_t light) {
  { sampler.choose(v, v, u) } -> std::same_as<std::optional<ChosenLight>>;
  { sampler.probability(v, v, light) } -> std::same_as<float>;
};

/// Chooses any light as often as any other.
class UniformLightSampler {
 public:
  UniformLightSampler() = default;

  template <Light L>
  UniformLightSampler(std::span<const L> lights, const Aabb<float>& /*scene*/) noexcept
      : count_(static_cast<std::uint32_t>(lights.size())) {}

  [[nodiscard]] std::optional<ChosenLight> choose(const Vec3<float>& /*from*/, const Vec3<float>& /*normal*/,
                                                  float u) const noexcept {
    if (count_ == 0) return std::nullopt;
    const auto index = static_cast<std::uint32_t>(u * static_cast<float>(count_));
    return ChosenLight{std::min(index, count_ - 1), 1 / static_cast<float>(count_)};
  }
  [[nodiscard]] float probability(const Vec3<float>& /*from*/, const Vec3<float>& /*normal*/,
                                  std::uint32_t /*light*/) const noexcept {
    return 1 / static_cast<float>(count_);
  }

 private:
  std::uint32_t count_ = 0;
};

/// Chooses lights in proportion to the luminance of their power, from wherever they are seen.
class PowerLightSampler {
 public:
  PowerLightSampler() = default;

  template <Light L>
  PowerLightSampler(std::span<const L> lights, const Aabb<float>& scene) : choice_(weights(lights, scene)) {}

  /// Requires: there is a light with power, see `empty()`.
  [[nodiscard]] ChosenLight choose(float u) const noexcept {
    const auto chosen = choice_.sample(u);
    return {static_cast<std::uint32_t>(chosen.index), chosen.probability};
  }
  [[nodiscard]] float probability(std::uint32_t light) const noexcept { return choice_.probability(light); }

  [[nodiscard]] std::optional<ChosenLight> choose(const Vec3<float>& /*from*/, const Vec3<float>& /*normal*/,
                                                  float u) const noexcept {
    if (empty()) return std::nullopt;
    return choose(u);
  }
  [[nodiscard]] float probability(const Vec3<float>& /*from*/, const Vec3<float>& /*normal*/,
                                  std::uint32_t light) const noexcept {
    return probability(light);
  }

  /// True where nothing shines.
  [[nodiscard]] bool empty() const noexcept { return !(choice_.total() > 0); }

 private:
  template <Light L>
  [[nodiscard]] static std::vector<float> weights(std::span<const L> lights, const Aabb<float>& scene) {
    std::vector<float> result;
    result.reserve(lights.size());
    for (const L& light : lights) {
      const float power = luminance(light.power(scene));
      result.push_back(power > 0 ? std::min(power, 1e30F) : 0.0F);  // a sun over an unbounded scene has infinite power
    }
    return result;
  }

  AliasTable choice_;
};

static_assert(LightSampler<UniformLightSampler> && LightSampler<PowerLightSampler>);

}  // namespace glint

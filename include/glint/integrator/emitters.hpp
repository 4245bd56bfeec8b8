// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/color/rgb.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/emission.hpp>
#include <glint/light/light_sampler.hpp>
#include <glint/math/distribution.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>

namespace glint {

/// A scene that knows where it ends.
template <typename S>
concept BoundedScene = SceneLike<S> && requires(const S& scene) {
  { scene.bounds() } -> std::same_as<Aabb<float>>;
};

/// A ray that leaves one of a scene's lights.
struct ChosenEmission {
  EmittedRay from{};
  std::uint32_t light = 0;
  float probability = 0;  ///< of the light

  /// What it stands for: watts over its density.
  [[nodiscard]] Rgb flux() const noexcept {
    const float cosine = std::abs(glm::dot(from.normal, from.ray.direction));
    return from.radiance * (cosine / (probability * from.pdf.position * from.pdf.direction));
  }
};

/// The lights of a scene, chosen from nowhere in particular, by power: where light paths begin.
class Emitters {
 public:
  Emitters() = default;

  template <BoundedScene S>
  explicit Emitters(const S& scene) : bounds_(scene.bounds()) {
    std::vector<float> powers;
    for (std::uint32_t i = 0; i < scene.light_count(); ++i) {
      const float power = luminance(scene.light(i).power(bounds_));
      powers.push_back(power > 0 ? std::min(power, 1e30F) : 0.0F);  // over an unbounded scene it may be infinite
    }
    choice_ = AliasTable(powers);
  }

  [[nodiscard]] const Aabb<float>& bounds() const noexcept { return bounds_; }
  [[nodiscard]] float probability(std::uint32_t light) const noexcept { return choice_.probability(light); }

  /// The density of a ray that leaves a light: that of the light's, its choice, and the scene's bounds put together.
  template <typename L>
  [[nodiscard]] float pdf(const L& light, std::uint32_t index, const Surface& at, const Vec3<float>& direction) const {
    const EmissionPdf pdf = emission_pdf(light, at, direction, bounds_);
    return probability(index) * pdf.position * pdf.direction;
  }

  /// Nothing where nothing shines.
  template <SceneLike S, Sampler R>
  [[nodiscard]] std::optional<ChosenEmission> sample(const S& scene, R& sampler) const {
    const float u = sampler.next_1d();
    const Vec2<float> u_position = sampler.next_2d();
    const Vec2<float> u_direction = sampler.next_2d();
    if (!(choice_.total() > 0)) return std::nullopt;
    const auto chosen = choice_.sample(u);
    const auto out = emit(scene.light(chosen.index), u_position, u_direction, bounds_);
    if (!out || !(out->pdf.position > 0 && out->pdf.direction > 0)) return std::nullopt;
    return ChosenEmission{*out, chosen.index, chosen.probability};
  }

 private:
  Aabb<float> bounds_{};
  AliasTable choice_;
};

}  // namespace glint

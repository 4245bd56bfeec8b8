// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/surface.hpp>
#include <glint/light/adaptive_light_sampler.hpp>
#include <glint/light/light_sampler.hpp>
#include <glint/light/lights.hpp>
#include <glint/material/concepts.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/interaction.hpp>
#include <glint/scene/path_footprint.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

/// Geometry whose hits can be shaded.
template <typename G>
concept ShadableRayCaster = RayCaster<G> && requires(const G& geometry, const Ray<typename G::Scalar>& ray,
                                                     const Hit<typename G::Scalar, typename G::Index>& hit) {
  { geometry.surface(ray, hit) } -> std::same_as<SurfaceOf<typename G::Scalar>>;
};

/// Names the way to choose among a scene's lights: Scene{geometry, materials, lights, choose_by<UniformLightSampler>}.
template <LightSampler S>
inline constexpr std::type_identity<S> choose_by{};

/// Geometry, what it is made of, and what lights it. Models SceneLike.
///
/// Shapes:  `Materials` is one material (or BSDF) for everything, or a table by primitive (MaterialTable).
/// Threads: const means shareable.
template <ShadableRayCaster Geometry, typename Materials = Lambertian, Light L = Darkness,
          LightSampler Choice = AdaptiveLightSampler>
  requires(Material<Materials> || MaterialTableLike<Materials>)
class Scene {
 public:
  using Bsdf = BsdfOf<Materials>;
  using Scalar = typename Geometry::Scalar;
  /// Whether a texture among the materials can be filtered; then `interact` takes footprints, too.
  static constexpr bool asks_for_footprints = glint::asks_for_footprints<Materials>;

  explicit Scene(Geometry geometry, Materials materials = {}, Lights<L> lights = {},
                 std::type_identity<Choice> /*choose_by*/ = {})
      : geometry_(std::move(geometry)),
        materials_(std::move(materials)),
        lights_(std::move(lights)),
        light_sampler_(std::span<const L>(lights_.all), bounds()) {
    for (std::uint32_t i = 0; i < light_count(); ++i) {
      if (is_infinite(light(i))) infinite_lights_.push_back(i);
    }
  }

  /// A scene with one light.
  Scene(Geometry geometry, Materials materials, L light)
      : Scene(std::move(geometry), std::move(materials), Lights<L>{{std::move(light)}}) {}

  /// The closest surface on the ray. Bsdf and frame are worked out there; nothing where the ray meets nothing.
  [[nodiscard]] std::optional<Interaction<Bsdf>> interact(const Ray<float>& ray) const {
    return interact(ray, NoFootprint{});
  }

  /// The same with a footprint of the path: NoFootprint or PathFootprint.
  template <typename F>
  [[nodiscard]] std::optional<Interaction<Bsdf>> interact(const Ray<float>& ray, const F& footprint) const {
    std::optional<Interaction<Bsdf>> result;
    const auto& in_scene = cast_ray(ray);
    const auto hit = geometry_.closest(in_scene);
    if (!hit) return result;
    Interaction<Bsdf>& at = result.emplace();  // filled in place: copies of what was just written stall the processor
    if constexpr (std::is_same_v<Scalar, float>) {
      at.surface = geometry_.surface(in_scene, *hit);
    } else {
      at.surface = surface_cast<float>(geometry_.surface(in_scene, *hit));
    }
    if constexpr (asks_for_footprints && std::is_same_v<F, PathFootprint>) {
      if (!footprint.is_thin()) at.surface.footprint = footprint_at(at.surface, ray, footprint.differential());
    }
    at.frame = Frame<float>::from_normal_and_tangent(at.surface.shading_normal, at.surface.tangent);
    at.wo = -normalized(ray.direction);
    at.bsdf = bsdf_at(materials_, at.surface, hit->primitive);
    at.primitive = hit->primitive;
    at.light = lights_.at_primitive(hit->primitive);
    return result;
  }

  /// The geometry's closest hit, as an optional Hit.
  [[nodiscard]] auto closest(const Ray<float>& ray) const { return geometry_.closest(cast_ray(ray)); }

  [[nodiscard]] bool occluded(const Ray<float>& ray) const { return geometry_.occluded(cast_ray(ray)); }

  /// The radiance of all lights at infinity.
  [[nodiscard]] Rgb background(const Vec3<float>& direction) const {
    Rgb sum;
    for (const std::uint32_t i : infinite_lights_) sum += glint::background(lights_.all[i], direction);
    return sum;
  }

  [[nodiscard]] std::uint32_t light_count() const noexcept { return static_cast<std::uint32_t>(lights_.all.size()); }
  /// Requires: i < light_count().
  [[nodiscard]] const L& light(std::uint32_t i) const noexcept { return lights_.all[i]; }
  [[nodiscard]] const Choice& light_sampler() const noexcept { return light_sampler_; }
  [[nodiscard]] std::span<const std::uint32_t> infinite_lights() const noexcept { return infinite_lights_; }

  [[nodiscard]] const Geometry& geometry() const noexcept { return geometry_; }
  [[nodiscard]] const Materials& materials() const noexcept { return materials_; }

  [[nodiscard]] Aabb<float> bounds() const {
    const auto box = geometry_.bounds();
    return {Vec3<float>(box.lower), Vec3<float>(box.upper)};
  }

 private:
  [[nodiscard]] static decltype(auto) cast_ray(const Ray<float>& ray) noexcept {
    if constexpr (std::is_same_v<Scalar, float>) {
      return (ray);
    } else {
      return Ray<Scalar>{Vec3<Scalar>(ray.origin), Vec3<Scalar>(ray.direction),
                         Scalar(ray.t_min),        Scalar(ray.t_max),
                         Scalar(ray.time),         ray.mask};
    }
  }

  Geometry geometry_;
  Materials materials_;
  Lights<L> lights_;
  Choice light_sampler_;
  std::vector<std::uint32_t> infinite_lights_;
};

template <typename G>
Scene(G) -> Scene<G>;
template <typename G, typename M>
Scene(G, M) -> Scene<G, M>;
template <typename G, typename M, Light L>
Scene(G, M, L) -> Scene<G, M, L>;
template <typename G, typename M, Light L>
Scene(G, M, Lights<L>) -> Scene<G, M, L>;
template <typename G, typename M, Light L, LightSampler C>
Scene(G, M, Lights<L>, std::type_identity<C>) -> Scene<G, M, L, C>;

}  // namespace glint

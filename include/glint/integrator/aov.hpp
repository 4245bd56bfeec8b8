// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <concepts>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/bsdf/albedo.hpp>
#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/core/index.hpp>
#include <glint/film/sample_statistics.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/integrator/light_shares.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/scene/concepts.hpp>
#include <glint/scene/interaction.hpp>

namespace glint {

/// An arbitrary output variable: what a picture shows of each pixel besides its light. `name` is what users call it,
/// `channels` are the names of its channels in files, `Value` is float, Vec2, Vec3, Rgb, or an integer for what cannot
/// be averaged. Which function it has says how it comes about:
///
/// - `at_surface(scene, ray, at, sampler)`, an optional Value: of what a camera ray meets, an optional Interaction. The
///   pixel is the mean over its samples; those without a value do not count. The sampler is a copy of the one that the
///   integrator begins with.
/// - `of_light(shares)`: of the light that a sample brings, by LightShares; the pixel is the mean.
/// - `of_samples(statistics)`: of all samples of the pixel, by SampleStatistics.
/// - `id(scene, hit)`: of what the ray through the pixel's center meets, an optional Hit.
///
/// The pixel's own samples count, whatever the film's filter.
template <typename A>
concept Aov = requires {
  typename A::Value;
  { A::name } -> std::convertible_to<std::string_view>;
  { A::channels[0] } -> std::convertible_to<std::string_view>;
};

template <typename A>
concept LightAov = Aov<A> && requires(const A& aov, const LightShares& shares) {
  { aov.of_light(shares) } -> std::same_as<typename A::Value>;
};

template <typename A>
concept SamplesAov = Aov<A> && requires(const A& aov, const SampleStatistics& statistics) {
  { aov.of_samples(statistics) } -> std::same_as<typename A::Value>;
};

/// What a scene's `interact` returns, and what its `closest` does.
template <typename S>
using InteractionOf = decltype(std::declval<const S&>().interact(Ray<float>{}));
template <typename S>
using HitOf = decltype(std::declval<const S&>().closest(Ray<float>{}));

template <typename A, typename S, typename R>
concept SurfaceAovFor = Aov<A> && SceneLike<S> && Sampler<R> &&
    requires(const A& aov, const S& scene, const Ray<float>& ray, const InteractionOf<S>& at, const R& sampler) {
  { aov.at_surface(scene, ray, at, sampler) } -> std::same_as<std::optional<typename A::Value>>;
};

template <typename A, typename S>
concept IdAovFor = Aov<A> && SceneLike<S> && requires(const A& aov, const S& scene, const HitOf<S>& hit) {
  { aov.id(scene, hit) } -> std::same_as<std::uint32_t>;
};

/// The surface that a ray shows: through mirrors and glass to the first that is not specular.
template <typename At>
struct SeenSurface {
  std::optional<At> at;  ///< nothing where light from nowhere is seen, or no surface within so many
  Rgb throughput{1};     ///< of the specular surfaces on the way
};

/// Follows a ray through specular surfaces, each of which chooses one way by its sample: the mean over many samples is
/// what is seen by reflection and refraction, each by its share.
///
/// Cost: a ray each specular surface.
template <SceneLike S, Bsdf B, Sampler R>
[[nodiscard]] SeenSurface<Interaction<B>> seen_surface(const S& scene, const std::optional<Interaction<B>>& first,
                                                       R& sampler, int most_specular = 16) {
  SeenSurface<Interaction<B>> seen{first};
  for (int i = 0; i < most_specular && seen.at && seen.at->bsdf.is_specular(); ++i) {
    const float lobe = sampler.next_1d();
    const auto scattered = seen.at->bsdf.sample(seen.at->to_local(seen.at->wo), lobe, sampler.next_2d());
    if (!scattered) return {std::nullopt};
    seen.throughput *= scattered->weight;
    seen.at = scene.interact(seen.at->leave(seen.at->to_world(scattered->wi)));
  }
  if (seen.at && seen.at->bsdf.is_specular()) seen.at.reset();
  return seen;
}

/// The output variables that renderers agree on.
namespace aov {

using namespace std::string_view_literals;

/// The directional albedo of the surface: the share of an even sky's light that it sends to the camera. Black where
/// there is none.
struct Albedo {
  using Value = Rgb;
  static constexpr auto name = "albedo"sv;
  static constexpr std::array channels{"albedo.R"sv, "albedo.G"sv, "albedo.B"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Rgb> at_surface(const S& /*scene*/, const Ray<float>& /*ray*/,
                                              const std::optional<Interaction<B>>& at, R sampler) const {
    if (!at) return Rgb{};
    const float lobe = sampler.next_1d();
    return estimated_albedo(at->bsdf, at->to_local(at->wo), lobe, sampler.next_2d());
  }
};

/// The shading normal in the world, on the primitive's outer side, of unit length before the mean is taken. Zero where
/// there is no surface.
struct Normal {
  using Value = Vec3<float>;
  static constexpr auto name = "normal"sv;
  static constexpr std::array channels{"N.X"sv, "N.Y"sv, "N.Z"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Vec3<float>> at_surface(const S& /*scene*/, const Ray<float>& /*ray*/,
                                                      const std::optional<Interaction<B>>& at,
                                                      const R& /*sampler*/) const {
    return at ? at->frame.z : Vec3<float>(0);
  }
};

/// The albedo of what is seen through mirrors and glass, colored by them: what denoisers ask for.
struct DenoiseAlbedo {
  using Value = Rgb;
  static constexpr auto name = "denoise_albedo"sv;
  static constexpr std::array channels{"denoise_albedo.R"sv, "denoise_albedo.G"sv, "denoise_albedo.B"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Rgb> at_surface(const S& scene, const Ray<float>& ray,
                                              const std::optional<Interaction<B>>& at, R sampler) const {
    const auto seen = seen_surface(scene, at, sampler);
    return seen.throughput * Albedo{}.at_surface(scene, ray, seen.at, sampler).value();
  }
};

/// The shading normal of what is seen through mirrors and glass.
struct DenoiseNormal {
  using Value = Vec3<float>;
  static constexpr auto name = "denoise_normal"sv;
  static constexpr std::array channels{"denoise_normal.X"sv, "denoise_normal.Y"sv, "denoise_normal.Z"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Vec3<float>> at_surface(const S& scene, const Ray<float>& ray,
                                                      const std::optional<Interaction<B>>& at, R sampler) const {
    return Normal{}.at_surface(scene, ray, seen_surface(scene, at, sampler).at, sampler);
  }
};

/// How far the surface is from where the ray begins, along the ray and in scene units: not the distance from the plane
/// of the camera. The mean is that of the samples that met a surface; infinite where there is none.
struct Depth {
  using Value = float;
  static constexpr auto name = "depth"sv;
  static constexpr std::array channels{"Z"sv};
  static constexpr float nowhere = infinity<float>;

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<float> at_surface(const S& /*scene*/, const Ray<float>& ray,
                                                const std::optional<Interaction<B>>& at, const R& /*sampler*/) const {
    if (!at) return std::nullopt;
    return glm::distance(at->surface.position, ray.origin);
  }
};

/// Where the surface is in the world; the mean over the samples that met one, zero where there is none.
struct Position {
  using Value = Vec3<float>;
  static constexpr auto name = "position"sv;
  static constexpr std::array channels{"P.X"sv, "P.Y"sv, "P.Z"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Vec3<float>> at_surface(const S& /*scene*/, const Ray<float>& /*ray*/,
                                                      const std::optional<Interaction<B>>& at,
                                                      const R& /*sampler*/) const {
    if (!at) return std::nullopt;
    return at->surface.position;
  }
};

/// The surface's texture coordinates; the mean over the samples that met one, zero where there is none.
struct Uv {
  using Value = Vec2<float>;
  static constexpr auto name = "uv"sv;
  static constexpr std::array channels{"uv.U"sv, "uv.V"sv};

  template <SceneLike S, Bsdf B, Sampler R>
  [[nodiscard]] std::optional<Vec2<float>> at_surface(const S& /*scene*/, const Ray<float>& /*ray*/,
                                                      const std::optional<Interaction<B>>& at,
                                                      const R& /*sampler*/) const {
    if (!at) return std::nullopt;
    return at->surface.uv;
  }
};

/// Which primitive of its set, or of the placed object it belongs to; 2³² − 1 where there is none.
struct PrimitiveId {
  using Value = std::uint32_t;
  static constexpr auto name = "primitive_id"sv;
  static constexpr std::array channels{"primitive_id"sv};

  template <SceneLike S, typename H>
  [[nodiscard]] std::uint32_t id(const S& /*scene*/, const std::optional<H>& hit) const {
    if (!hit) return none<std::uint32_t>;
    return static_cast<std::uint32_t>(is_placed(*hit) ? hit->inner : hit->primitive);
  }

  /// Whether the primitive belongs to an object placed by Instanced.
  template <typename H>
  [[nodiscard]] static constexpr bool is_placed(const H& hit) noexcept {
    return hit.inner != none<decltype(hit.inner)>;
  }
};

/// Which of the objects placed by Instanced; 2³² − 1 where there is none.
struct InstanceId {
  using Value = std::uint32_t;
  static constexpr auto name = "instance_id"sv;
  static constexpr std::array channels{"instance_id"sv};

  template <SceneLike S, typename H>
  [[nodiscard]] std::uint32_t id(const S& /*scene*/, const std::optional<H>& hit) const {
    return hit && PrimitiveId::is_placed(*hit) ? static_cast<std::uint32_t>(hit->primitive) : none<std::uint32_t>;
  }
};

/// Which material of the scene's MaterialTable, 0 where it has no such table; 2³² − 1 where there is no surface.
struct MaterialId {
  using Value = std::uint32_t;
  static constexpr auto name = "material_id"sv;
  static constexpr std::array channels{"material_id"sv};

  template <SceneLike S, typename H>
  [[nodiscard]] std::uint32_t id(const S& scene, const std::optional<H>& hit) const {
    if (!hit) return none<std::uint32_t>;
    if constexpr (requires { scene.materials().of_primitive[0]; }) {
      return scene.materials().of_primitive[hit->primitive];
    } else {
      return 0;
    }
  }
};

/// Light that is seen where it comes from, on lamps and in the background.
struct Emission {
  using Value = Rgb;
  static constexpr auto name = "emission"sv;
  static constexpr std::array channels{"emission.R"sv, "emission.G"sv, "emission.B"sv};

  [[nodiscard]] constexpr Rgb of_light(const LightShares& shares) const noexcept { return shares.emission; }
};

/// Light that was scattered once.
struct Direct {
  using Value = Rgb;
  static constexpr auto name = "direct"sv;
  static constexpr std::array channels{"direct.R"sv, "direct.G"sv, "direct.B"sv};

  [[nodiscard]] constexpr Rgb of_light(const LightShares& shares) const noexcept { return shares.direct; }
};

/// Light that was scattered more often.
struct Indirect {
  using Value = Rgb;
  static constexpr auto name = "indirect"sv;
  static constexpr std::array channels{"indirect.R"sv, "indirect.G"sv, "indirect.B"sv};

  [[nodiscard]] constexpr Rgb of_light(const LightShares& shares) const noexcept { return shares.indirect; }
};

/// How many samples the pixel is the mean of: those that were not finite are not among them.
struct SampleCount {
  using Value = std::uint32_t;
  static constexpr auto name = "samples"sv;
  static constexpr std::array channels{"samples"sv};

  [[nodiscard]] std::uint32_t of_samples(const SampleStatistics& statistics) const noexcept {
    return statistics.count();
  }
};

/// The variance of the mean of the pixel's samples, channel by channel: see SampleStatistics::variance_of_mean.
struct Variance {
  using Value = Rgb;
  static constexpr auto name = "variance"sv;
  static constexpr std::array channels{"variance.R"sv, "variance.G"sv, "variance.B"sv};

  [[nodiscard]] Rgb of_samples(const SampleStatistics& statistics) const noexcept {
    return statistics.variance_of_mean();
  }
};

}  // namespace aov

}  // namespace glint

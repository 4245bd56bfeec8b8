// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <glm/geometric.hpp>

#include <glint/camera/importance.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/integrator/direct_light.hpp>
#include <glint/integrator/emitters.hpp>
#include <glint/integrator/light_scattering.hpp>
#include <glint/integrator/path_densities.hpp>
#include <glint/integrator/roulette.hpp>
#include <glint/light/concepts.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

class PreparedBdpt;

/// A bidirectional path tracer: a path from the camera and one from a light, joined in every possible way, each way
/// weighed by the power heuristic. All of Path's light, with less noise where light comes around corners or through
/// glass.
///
/// A path that ends at a light by chance, one that looks for a light, one shown to the camera, and all in between
/// count; the light seen directly is left to chance alone. Lights that do not answer emit(), and cameras that do not
/// answer sample_toward(), just have fewer ways.
///
/// Requires: max_depth ≤ 64, more counts as 64; BSDFs are trivially copyable.
/// Source:   Lafortune, Willems, "Bi-Directional Path Tracing" (1993); Veach (1997), chapter 10.
struct Bdpt {
  static constexpr int deepest = 64;

  int max_depth = 12;           ///< segments from camera to light, as in Path
  float roulette_below = 0.1F;  ///< as in Path, for both paths

  template <BoundedScene S>
  [[nodiscard]] PreparedBdpt prepare(const S& scene) const;
};

/// The bidirectional path tracer of one scene.
class PreparedBdpt {
 public:
  PreparedBdpt(const Bdpt& options, Emitters emitters)
      : max_depth_(std::min(options.max_depth, Bdpt::deepest)),
        roulette_below_(options.roulette_below),
        emitters_(std::move(emitters)) {}

  template <SceneLike S, Sampler R, RayGenerator G, typename Splat, typename F = NoFootprint>
  [[nodiscard]] Rgb radiance(const S& scene, Ray<float> ray, R& sampler, const G& camera, const Splat& splat,
                             F footprint = {}) const {
    using At = std::remove_cvref_t<decltype(*scene.interact(ray))>;
    FixedStack<Vertex<At>, Bdpt::deepest> light_path;
    trace_light(scene, sampler, camera, splat, light_path);

    Rgb throughput{1};
    Rgb sum;
    Arrival arrival{.from = ray.origin};
    for (; arrival.segments <= max_depth_; ++arrival.segments) {
      const auto at = interact(scene, ray, footprint);
      if (!at) return sum + throughput * found_background(scene, ray.direction, arrival);
      if (!arrive(arrival, camera, ray, *at)) break;
      const Vertex<At> vertex{*at, at->to_local(at->wo), throughput, arrival.densities};
      if (at->light < scene.light_count()) sum += throughput * found_light(scene, vertex, arrival);
      if (arrival.segments == max_depth_) break;
      if (!at->bsdf.is_specular()) sum += joined(scene, vertex, light_path, arrival.segments, sampler);

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(vertex.wo, lobe, sampler.next_2d());
      if (!scattered) break;
      const Vec3<float> direction = at->to_world(scattered->wi);
      throughput *= scattered->weight;
      if (!survives_roulette(throughput, roulette_below_, sampler)) break;
      leave(arrival.densities, vertex, *scattered, direction);
      arrival.from = at->surface.position;
      arrival.normal = at->frame.z;
      ray = at->leave(direction);
      footprint.scatter(*at, *scattered, direction);
    }
    return sum;
  }

 private:
  /// How the camera's path came to where it is.
  struct Arrival {
    Vec3<float> from{0.0F};
    Vec3<float> normal{0.0F};  ///< for shading, there
    PathDensities densities{};
    int segments = 1;
  };

  template <typename At>
  struct Vertex {
    At at;
    Vec3<float> wo;  ///< to where the path came from, in the shading frame
    Rgb carried;     ///< from the camera throughput, from a light flux
    PathDensities densities;
  };

  template <typename At>
  [[nodiscard]] static float cosine(const At& at, const Vec3<float>& direction) noexcept {
    return std::abs(glm::dot(at.surface.normal, direction));
  }

  [[nodiscard]] static float weight(double others) noexcept { return static_cast<float>(1 / (1 + others)); }

  template <typename At>
  static void leave(PathDensities& densities, const Vertex<At>& vertex, const BsdfSample& scattered,
                    const Vec3<float>& direction) {
    const bool specular = scattered.lobe == Lobe::Specular;
    const float reverse = specular ? 0.0F : vertex.at.bsdf.pdf(scattered.wi, vertex.wo);
    densities.leave(scattered, static_cast<double>(cosine(vertex.at, direction)), static_cast<double>(reverse));
  }

  /// False where the surface is seen from its edge, from where nothing is.
  template <RayGenerator G, typename At>
  [[nodiscard]] static bool arrive(Arrival& arrival, const G& camera, const Ray<float>& ray, const At& at) {
    const float squared_distance = length_squared(at.surface.position - arrival.from);
    const float cos_in = cosine(at, at.wo);
    if (!(cos_in > 0)) return false;
    if (arrival.segments > 1) {
      arrival.densities.arrive(static_cast<double>(squared_distance), static_cast<double>(cos_in));
      return true;
    }
    const float density = importance(camera, ray, std::sqrt(squared_distance)) * cos_in;
    if (density > 0) arrival.densities.last = 1 / PathDensities::squared(static_cast<double>(density));
    return true;
  }

  /// A vertex of the camera's path joined to a light, and to the vertices of the light's path.
  template <SceneLike S, typename At, typename Path, Sampler R>
  [[nodiscard]] Rgb joined(const S& scene, const Vertex<At>& vertex, Path& light_path, int segments, R& sampler) const {
    Rgb sum = vertex.carried * looked_for_light(scene, vertex, sampler);
    const auto count = std::min(light_path.size(), static_cast<std::size_t>(max_depth_ - segments - 1));
    for (std::size_t i = 0; i < count; ++i) sum += connected(scene, vertex, light_path[i]);
    return sum;
  }

  /// The path from a light, up to where one more segment leads to the camera. Each vertex is shown to the camera.
  template <SceneLike S, Sampler R, RayGenerator G, typename Splat, typename Path>
  void trace_light(const S& scene, R& sampler, const G& camera, const Splat& splat, Path& path) const {
    const Vec2<float> lens = sampler.next_2d();
    const auto start = emitters_.sample(scene, sampler);
    if (!start || max_depth_ < 2) return;
    const Rgb flux = start->flux();
    Rgb throughput{1};
    PathDensities densities;
    Ray<float> ray = start->from.ray;
    Vec3<float> from = ray.origin;
    for (int segments = 1; segments < max_depth_; ++segments) {
      const auto at = scene.interact(ray);
      if (!at) return;
      const float squared_distance = length_squared(at->surface.position - from);
      const float cos_in = cosine(*at, at->wo);
      if (!(cos_in > 0)) return;
      if (segments == 1) {
        densities = first_densities(scene, *start, *at, squared_distance, cos_in);
      } else {
        densities.arrive(static_cast<double>(squared_distance), static_cast<double>(cos_in));
      }
      const Vertex<std::remove_cvref_t<decltype(*at)>> vertex{*at, at->to_local(at->wo), flux * throughput, densities};
      if (!at->bsdf.is_specular()) show(scene, vertex, camera, lens, splat);
      path.push(vertex);
      if (segments + 1 == max_depth_) return;

      const float lobe = sampler.next_1d();
      const auto scattered = at->bsdf.sample(vertex.wo, lobe, sampler.next_2d());
      if (!scattered) return;
      const Vec3<float> direction = at->to_world(scattered->wi);
      throughput *= flux_weight(*at, vertex.wo, *scattered, direction);
      if (!survives_roulette(throughput, roulette_below_, sampler)) return;
      leave(densities, vertex, *scattered, direction);
      from = at->surface.position;
      ray = at->leave(direction);
    }
  }

  /// At the first surface that light falls on: what it takes to look for the light from there, or to meet it by chance.
  template <SceneLike S, typename At>
  [[nodiscard]] PathDensities first_densities(const S& scene, const ChosenEmission& start, const At& at,
                                              float squared_distance, float cos_in) const {
    const auto& light = scene.light(start.light);
    const EmittedRay& out = start.from;
    const Vec3<float>& position = at.surface.position;
    const bool infinite = is_infinite(light);
    const double cos_light = static_cast<double>(std::abs(glm::dot(out.normal, out.ray.direction)));
    double direct = 1;  // by solid angle, times the light's cosine
    if (out.is_delta_position) {
      direct = static_cast<double>(squared_distance);
    } else if (infinite) {
      direct = static_cast<double>(background_pdf(light, -out.ray.direction));
    } else if (!out.is_delta_direction) {
      const Surface on_light{.position = out.ray.origin, .normal = out.normal};
      direct = static_cast<double>(surface_pdf(light, position, on_light)) * cos_light;
    }
    direct *= static_cast<double>(scene.light_sampler().probability(position, at.frame.z, start.light));
    const double emitted = static_cast<double>(start.probability) * static_cast<double>(out.pdf.position) *
                           static_cast<double>(out.pdf.direction) * static_cast<double>(cos_in);
    const bool delta = out.is_delta_position || out.is_delta_direction;
    return {PathDensities::squared(direct / emitted), delta ? 0 : PathDensities::squared(cos_light / emitted)};
  }

  /// What a surface that a light path has met sends to the camera.
  template <SceneLike S, typename At, RayGenerator G, typename Splat>
  static void show(const S& scene, const Vertex<At>& vertex, const G& camera, const Vec2<float>& lens,
                   const Splat& splat) {
    const At& at = vertex.at;
    const auto seen = sample_toward(camera, at.surface.position, lens);
    if (!seen) return;
    const Vec3<float> wi = at.to_local(seen->wi);
    const Rgb value = vertex.carried * scattered_flux(at, vertex.wo, seen->wi, wi) * seen->importance;
    if (is_black(value) || scene.occluded(at.leave_to(seen->target))) return;
    const auto pdf = static_cast<double>(seen->importance * cosine(at, seen->wi));
    splat(seen->film, value * weight(vertex.densities.others(pdf, static_cast<double>(at.bsdf.pdf(wi, vertex.wo)))));
  }

  /// A light met by chance.
  template <SceneLike S, typename At>
  [[nodiscard]] Rgb found_light(const S& scene, const Vertex<At>& vertex, const Arrival& arrival) const {
    const At& at = vertex.at;
    const auto& light = scene.light(at.light);
    const Rgb radiance = emission(light, at.surface, at.wo);
    if (arrival.segments == 1 || is_black(radiance)) return radiance;
    const float to_area = cosine(at, at.wo) / length_squared(at.surface.position - arrival.from);
    const float direct = scene.light_sampler().probability(arrival.from, arrival.normal, at.light) *
                         surface_pdf(light, arrival.from, at.surface) * to_area;
    const float emitted = emitters_.pdf(light, at.light, at.surface, at.wo);
    return radiance * weight(vertex.densities.others_at_end(static_cast<double>(direct), static_cast<double>(emitted)));
  }

  template <SceneLike S>
  [[nodiscard]] Rgb found_background(const S& scene, const Vec3<float>& direction, const Arrival& arrival) const {
    if (arrival.segments == 1) return scene.background(direction);
    Rgb sum;
    for (const std::uint32_t i : scene.infinite_lights()) {
      const auto& light = scene.light(i);
      const float direct =
          scene.light_sampler().probability(arrival.from, arrival.normal, i) * background_pdf(light, direction);
      const float emitted = emitters_.pdf(light, i, Surface{}, -direction);
      sum += background(light, direction) *
             weight(arrival.densities.others_at_end(static_cast<double>(direct), static_cast<double>(emitted)));
    }
    return sum;
  }

  /// Next-event estimation, as in Path.
  template <SceneLike S, typename At, Sampler R>
  [[nodiscard]] Rgb looked_for_light(const S& scene, const Vertex<At>& vertex, R& sampler) const {
    const At& at = vertex.at;
    const float choice = sampler.next_1d();
    const Vec2<float> u = sampler.next_2d();
    const auto chosen = scene.light_sampler().choose(at.surface.position, at.frame.z, choice);
    if (!chosen) return {};
    const auto& light = scene.light(chosen->index);
    const auto sample = light.sample(at.surface.position, u);
    if (!sample) return {};
    const Rgb value = reflected(scene, at, vertex.wo, *sample);
    if (is_black(value)) return {};
    const float pdf = chosen->probability * sample->pdf;
    const Vec3<float> wi = at.to_local(sample->wi);
    const double chance =
        sample->is_delta ? 0 : static_cast<double>(at.bsdf.pdf(vertex.wo, wi)) / static_cast<double>(pdf);
    const double found = lit_density(light, *chosen, *sample) * static_cast<double>(cosine(at, sample->wi));
    const double others = vertex.densities.others(found, static_cast<double>(at.bsdf.pdf(wi, vertex.wo)));
    return value * (weight(PathDensities::squared(chance) + others) / pdf);
  }

  /// The density of light falling on a facing surface by emission, over that of having chosen the sample.
  template <typename L>
  [[nodiscard]] double lit_density(const L& light, const ChosenLight& chosen, const LightSample& sample) const {
    const Surface at{.position = sample.target, .normal = sample.normal};
    const auto emitted = static_cast<double>(emitters_.pdf(light, chosen.index, at, -sample.wi));
    if (!(emitted > 0)) return 0;
    double direct = static_cast<double>(chosen.probability) * static_cast<double>(sample.pdf);
    if (std::isfinite(sample.distance)) {
      direct *= static_cast<double>(sample.is_delta ? sample.distance * sample.distance
                                                    : std::abs(glm::dot(sample.normal, sample.wi)));
    }
    return direct > 0 ? emitted / direct : 0;
  }

  /// A vertex of the camera's path joined to one of the light's.
  template <SceneLike S, typename At>
  [[nodiscard]] static Rgb connected(const S& scene, const Vertex<At>& eye, const Vertex<At>& lit) {
    if (lit.at.bsdf.is_specular()) return {};
    const Vec3<float> between = lit.at.surface.position - eye.at.surface.position;
    const float squared_distance = length_squared(between);
    if (!(squared_distance > 0)) return {};
    const Vec3<float> w = between / std::sqrt(squared_distance);
    const Vec3<float> eye_wi = eye.at.to_local(w);
    const Rgb scattered = eye.carried * eye.at.bsdf.evaluate(eye.wo, eye_wi);
    if (is_black(scattered)) return {};
    const Vec3<float> lit_wi = lit.at.to_local(-w);
    const Rgb value = scattered * lit.carried * scattered_flux(lit.at, lit.wo, -w, lit_wi) / squared_distance;
    if (is_black(value) || scene.occluded(spawn_ray_to(eye.at.surface, lit.at.surface))) return {};

    const float finds_lit = eye.at.bsdf.pdf(eye.wo, eye_wi) * cosine(lit.at, w) / squared_distance;
    const float finds_eye = lit.at.bsdf.pdf(lit.wo, lit_wi) * cosine(eye.at, w) / squared_distance;
    const float lit_reverse = lit.at.bsdf.pdf(lit_wi, lit.wo);
    const float eye_reverse = eye.at.bsdf.pdf(eye_wi, eye.wo);
    const double others = lit.densities.others(static_cast<double>(finds_lit), static_cast<double>(lit_reverse)) +
                          eye.densities.others(static_cast<double>(finds_eye), static_cast<double>(eye_reverse));
    return value * weight(others);
  }

  int max_depth_;
  float roulette_below_;
  Emitters emitters_;
};

template <BoundedScene S>
PreparedBdpt Bdpt::prepare(const S& scene) const {
  return {*this, Emitters(scene)};
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glint/camera/orthographic.hpp>
#include <glint/camera/panoramic.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/camera/thin_lens.hpp>
#include <glint/color/tone_curve.hpp>
#include <glint/core/one_of.hpp>
#include <glint/film/filter.hpp>
#include <glint/integrator/ambient_occlusion.hpp>
#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/direct.hpp>
#include <glint/integrator/intersection_test.hpp>
#include <glint/integrator/light_tracer.hpp>
#include <glint/integrator/normals.hpp>
#include <glint/integrator/path.hpp>
#include <glint/integrator/path_limits.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/io/json_object.hpp>
#include <glint/light/point.hpp>
#include <glint/math/constants.hpp>
#include <glint/sampler/halton.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/sampler/sobol.hpp>
#include <glint/sampler/stratified.hpp>
#include <glint/sampler/z_sobol.hpp>

/// What a scene file says about how to render it: everything but the scene itself.
namespace glint {

using SceneCamera = OneOf<Perspective, ThinLens, Orthographic, Panoramic>;
using SceneFilter = OneOf<BoxFilter, TentFilter, GaussianFilter, MitchellFilter>;
using SceneIntegrator = OneOf<IntersectionTest, Path, Direct, LightTracer, Bdpt, AmbientOcclusion, Normals>;
using SceneSequence = OneOf<Independent, Stratified, Halton, Sobol, ZSobol>;

struct FilmSettings {
  Vec2i resolution{600, 600};
  SceneFilter filter{};
  ToneCurve tone = ToneCurve::Clip;  ///< of pictures in 8 bits
};

struct IntegratorSettings {
  SceneIntegrator integrator = Path{};
  int samples = 32;                        ///< camera paths a pixel
  std::vector<PointLight> point_lights{};  ///< those that the integrator's own keys name
};

enum class SamplerKind : std::uint8_t { Independent, Stratified, Halton, Sobol, ZSobol };

struct SamplerSettings {
  SamplerKind kind = SamplerKind::ZSobol;
  std::uint64_t seed = 0;
};

enum class BuilderKind : std::uint8_t { Median, Morton, BinnedSah, SweepSah, SpatialSah, Best };

struct AcceleratorSettings {
  BuilderKind builder = BuilderKind::BinnedSah;
};

/// The random numbers that the settings ask for.
[[nodiscard]] inline SceneSequence sequence_of(const SamplerSettings& settings, int samples) {
  switch (settings.kind) {
    case SamplerKind::Stratified:
      return Stratified{.samples_per_pixel = samples, .seed = settings.seed};
    case SamplerKind::Halton:
      return Halton{.seed = settings.seed};
    case SamplerKind::Sobol:
      return Sobol{.seed = settings.seed};
    case SamplerKind::ZSobol:
      return ZSobol{.samples_per_pixel = samples, .seed = settings.seed};
    case SamplerKind::Independent:
      break;
  }
  return Independent{.seed = settings.seed};
}

namespace detail {

/// The choice that a word names. Errors: IoError that lists the words.
template <typename T, std::size_t N>
[[nodiscard]] T choice(const JsonValue& value, const std::array<std::pair<std::string_view, T>, N>& choices) {
  const std::string word = value.text();
  std::vector<std::string> words;
  for (const auto& [name, result] : choices) {
    if (name == word) return result;
    words.emplace_back(name);
  }
  std::string problem = "found \"" + word + "\", expected one of";
  for (const std::string& name : words) problem += (name == words.front() ? " \"" : ", \"") + name + "\"";
  value.fail(problem + suggestion(word, words));
}

template <typename T, std::size_t N>
[[nodiscard]] T choice_or(JsonObject& object, const std::string& key, T fallback,
                          const std::array<std::pair<std::string_view, T>, N>& choices) {
  const auto found = object.find(key);
  return found ? choice(*found, choices) : fallback;
}

/// Where there is just one "type", which may be left out.
inline void require_type(JsonObject& object, std::string_view name) {
  const std::array<std::pair<std::string_view, bool>, 1> only{{{name, true}}};
  (void)choice_or(object, "type", true, only);
}

[[nodiscard]] inline PointLight read_point_light(JsonObject& light) {
  require_type(light, "point");
  const Vec3<float> position = light.require("position").vec3();
  if (light.has("flux") == light.has("intensity")) light.fail("a point light has either \"flux\" or \"intensity\"");
  return light.has("flux") ? PointLight::from_flux(position, light.require("flux").color())
                           : PointLight{position, light.require("intensity").color()};
}

/// The point lights that an integrator brings along: those it names or, where `has_default`, one over the origin.
[[nodiscard]] inline std::vector<PointLight> read_own_point_lights(JsonObject& integrator, bool has_default) {
  std::vector<PointLight> result;
  for (const JsonValue& item : integrator.items("point_lights")) {
    JsonObject light(item);
    result.push_back(read_point_light(light));
    light.finish();
  }
  const bool named = integrator.has("point_light_position") || integrator.has("point_light_flux");
  const Vec3<float> position = integrator.vec3_or("point_light_position", {0, 5, 0});
  const Rgb flux = integrator.color_or("point_light_flux", 1);
  if (named || (has_default && result.empty())) result.push_back(PointLight::from_flux(position, flux));
  return result;
}

enum class IntegratorKind : std::uint8_t {
  IntersectionTest,
  Path,
  RandomWalk,
  Direct,
  LightTracer,
  Bdpt,
  AmbientOcclusion,
  Normals,
  Photon
};

inline constexpr std::array<std::pair<std::string_view, IntegratorKind>, 9> integrator_kinds{
    {{"intersection_test", IntegratorKind::IntersectionTest},
     {"path", IntegratorKind::Path},
     {"random_walk", IntegratorKind::RandomWalk},
     {"direct", IntegratorKind::Direct},
     {"light_tracer", IntegratorKind::LightTracer},
     {"bdpt", IntegratorKind::Bdpt},
     {"ambient_occlusion", IntegratorKind::AmbientOcclusion},
     {"normals", IntegratorKind::Normals},
     {"photon", IntegratorKind::Photon}}};
inline constexpr std::array<std::pair<std::string_view, LightStrategy>, 6> light_strategies{
    {{"MIS", LightStrategy::Mis},
     {"MultipleImportanceSampling", LightStrategy::Mis},
     {"NEE", LightStrategy::NextEvent},
     {"NextEventEstimation", LightStrategy::NextEvent},
     {"RW", LightStrategy::RandomWalk},
     {"RandomWalk", LightStrategy::RandomWalk}}};
inline constexpr std::array<std::pair<std::string_view, Falloff>, 3> falloffs{
    {{"inverse_square", Falloff::InverseSquare}, {"none", Falloff::None}, {"square", Falloff::Square}}};

/// What an integrator's keys say, whichever it is.
struct IntegratorOptions {
  int max_depth;
  float roulette;
  float distance;
  LightStrategy strategy;
  BounceLimits limits;
  LightClamp clamp;
  Falloff falloff;
};

[[nodiscard]] inline BounceLimits read_bounce_limits(JsonObject& integrator) {
  const auto limit = [&](const char* key) { return integrator.integer_or(key, BounceLimits::unlimited, 0); };
  return {.diffuse = limit("max_diffuse"), .glossy = limit("max_glossy"), .transmissive = limit("max_transmissive")};
}

[[nodiscard]] inline SceneIntegrator make_integrator(IntegratorKind kind, const IntegratorOptions& options) {
  switch (kind) {
    case IntegratorKind::IntersectionTest:
      return IntersectionTest{.max_depth = options.max_depth, .falloff = options.falloff};
    case IntegratorKind::Direct:
      return Direct{.max_depth = options.max_depth, .strategy = options.strategy};
    case IntegratorKind::LightTracer:
      return LightTracer{.max_depth = options.max_depth, .roulette_below = options.roulette};
    case IntegratorKind::Bdpt:
      return Bdpt{.max_depth = options.max_depth, .roulette_below = options.roulette};
    case IntegratorKind::AmbientOcclusion:
      return AmbientOcclusion{.distance = options.distance};
    case IntegratorKind::Normals:
      return Normals{};
    case IntegratorKind::Path:
    case IntegratorKind::RandomWalk:
    case IntegratorKind::Photon:
      break;
  }
  const bool walk = kind == IntegratorKind::RandomWalk;
  return Path{.max_depth = options.max_depth,
              .roulette_below = options.roulette,
              .strategy = walk ? LightStrategy::RandomWalk : options.strategy,
              .limits = options.limits,
              .clamp = options.clamp};
}

}  // namespace detail

/// `scene_has_lights`: whether the file lists lights, so that `intersection_test` need not bring its default one.
[[nodiscard]] inline IntegratorSettings read_integrator(JsonObject object, bool scene_has_lights) {
  using detail::IntegratorKind;
  const auto kind = detail::choice_or(object, "type", IntegratorKind::Path, detail::integrator_kinds);
  const bool test = kind == IntegratorKind::IntersectionTest;
  if (kind == IntegratorKind::Photon) {
    object.source().note(object.pointer() + "/type", "rendered with \"path\", as this integrator is not available");
  }
  IntegratorSettings result;
  result.samples = object.integer_or("spp", test ? 8 : 32, 1, 1 << 24);
  result.integrator = detail::make_integrator(
      kind, {.max_depth = object.integer_or("max_depth", test ? 16 : 12, 1),
             .roulette = object.not_negative_or("rr_threshold", 0.1F),
             .distance = object.positive_or("distance", infinity<float>),
             .strategy = detail::choice_or(object, "profile", LightStrategy::Mis, detail::light_strategies),
             .limits = detail::read_bounce_limits(object),
             .clamp = {.direct = object.positive_or("clamp_direct", infinity<float>),
                       .indirect = object.positive_or("clamp_indirect", infinity<float>)},
             .falloff = detail::choice_or(object, "falloff", Falloff::InverseSquare, detail::falloffs)});
  result.point_lights = detail::read_own_point_lights(object, test && !scene_has_lights);
  object.ignore({"n_photons", "n_iterations", "n_near_photons"});
  object.finish();
  return result;
}

namespace detail {

enum class FilterKind : std::uint8_t { Box, Tent, Gaussian, Mitchell };

inline constexpr std::array<std::pair<std::string_view, FilterKind>, 4> filter_kinds{
    {{"box", FilterKind::Box},
     {"tent", FilterKind::Tent},
     {"gaussian", FilterKind::Gaussian},
     {"mitchell", FilterKind::Mitchell}}};

[[nodiscard]] inline SceneFilter read_filter(JsonObject object) {
  const auto kind = choice_or(object, "type", FilterKind::Box, filter_kinds);
  const float radius = object.read_or("radius", 0.5F, [](const JsonValue& v) {
    return v.number_where([](float r) { return r > 0 && r <= 8; }, "a number above 0, 8 at most");
  });
  const float alpha = object.positive_or("alpha", 2);
  const float b = object.number_or("B", 1.0F / 3);
  const float c = object.number_or("C", 1.0F / 3);
  object.finish();
  if (kind == FilterKind::Tent) return TentFilter{radius};
  if (kind == FilterKind::Gaussian) return GaussianFilter{.radius = radius, .alpha = alpha};
  if (kind == FilterKind::Mitchell) return MitchellFilter{.radius = radius, .b = b, .c = c};
  return BoxFilter{radius};
}

}  // namespace detail

[[nodiscard]] inline FilmSettings read_film(JsonObject object) {
  FilmSettings result;
  if (const auto resolution = object.find("resolution")) {
    const auto sides = resolution->items("[width, height]");
    if (sides.size() != 2) resolution->fail_expected("[width, height]");
    result.resolution = {sides[0].integer(1, 65536), sides[1].integer(1, 65536)};
    if (std::int64_t{result.resolution.x} * result.resolution.y > max_image_pixels) {
      resolution->fail("found " + resolution->json().dump() + ", expected at most " + std::to_string(max_image_pixels) +
                       " pixels in all");
    }
  }
  if (const auto filter = object.find("filter")) result.filter = detail::read_filter(JsonObject(*filter));
  result.tone = detail::choice_or(object, "tone", ToneCurve::Clip, tone_curves);
  object.ignore({"block_side_length"});
  object.finish();
  return result;
}

namespace detail {

enum class CameraKind : std::uint8_t { Perspective, ThinLens, Orthographic, Panoramic };

inline constexpr std::array<std::pair<std::string_view, CameraKind>, 4> camera_kinds{
    {{"perspective", CameraKind::Perspective},
     {"thin_lens", CameraKind::ThinLens},
     {"orthographic", CameraKind::Orthographic},
     {"panoramic", CameraKind::Panoramic}}};

}  // namespace detail

[[nodiscard]] inline SceneCamera read_camera(JsonObject object) {
  const auto kind = detail::choice_or(object, "type", detail::CameraKind::Perspective, detail::camera_kinds);
  const Vec3<float> eye = object.vec3_or("position", {0, 0, 1});
  const Vec3<float> target = object.vec3_or("look_at", {0, 0, 0});
  const Vec3<float> up = object.vec3_or("ref_up", {0, 1, 0});
  if (eye == target) object.fail("\"position\" and \"look_at\" are the same point");
  const float fov = radians(object.read_or("fov", 45.0F, [](const JsonValue& v) {
    return v.number_where([](float degrees) { return degrees > 0 && degrees < 180; },
                          "an angle between 0 and 180 degrees");
  }));
  object.ignore({"focal_length"});
  SceneCamera result = Perspective{.eye = eye, .target = target, .up = up, .fov_y_radians = fov};
  if (kind == detail::CameraKind::ThinLens) {
    const float lens_radius = object.not_negative_or("lens_radius", 0.05F);
    const float focus_distance = object.positive_or("focus_distance", glm::length(target - eye));
    result = ThinLens{eye, target, up, fov, lens_radius, focus_distance};
  } else if (kind == detail::CameraKind::Orthographic) {
    result = Orthographic{.eye = eye, .target = target, .up = up, .height = object.positive_or("height", 1)};
  } else if (kind == detail::CameraKind::Panoramic) {
    result = Panoramic{.eye = eye, .target = target, .up = up};
  }
  object.finish();
  return result;
}

[[nodiscard]] inline SamplerSettings read_sampler(JsonObject object) {
  static constexpr std::array<std::pair<std::string_view, SamplerKind>, 5> kinds{
      {{"independent", SamplerKind::Independent},
       {"stratified", SamplerKind::Stratified},
       {"halton", SamplerKind::Halton},
       {"sobol", SamplerKind::Sobol},
       {"zsobol", SamplerKind::ZSobol}}};
  SamplerSettings result;
  result.kind = detail::choice_or(object, "type", SamplerKind::ZSobol, kinds);
  result.seed = object.read_or("seed", std::uint64_t{0}, [](const JsonValue& v) { return v.seed(); });
  object.finish();
  return result;
}

[[nodiscard]] inline AcceleratorSettings read_accelerator(JsonObject object) {
  static constexpr std::array<std::pair<std::string_view, BuilderKind>, 7> kinds{{{"median", BuilderKind::Median},
                                                                                  {"morton", BuilderKind::Morton},
                                                                                  {"ploc", BuilderKind::Morton},
                                                                                  {"sah", BuilderKind::BinnedSah},
                                                                                  {"sweep_sah", BuilderKind::SweepSah},
                                                                                  {"spatial", BuilderKind::SpatialSah},
                                                                                  {"best", BuilderKind::Best}}};
  AcceleratorSettings result;
  result.builder = detail::choice_or(object, "builder", BuilderKind::BinnedSah, kinds);
  if (const auto width = object.find("width")) {
    const int children = width->integer(2, 8);
    if (children != 2 && children != 4 && children != 8)
      width->fail("found " + width->json().dump() + ", expected 2, 4 or 8");
    if (children != 8) object.source().note(width->pointer(), "has no effect: nodes have up to 8 children");
  }
  object.finish();
  return result;
}

}  // namespace glint

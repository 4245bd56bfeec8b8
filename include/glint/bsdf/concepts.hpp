// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstdint>
#include <optional>

#include <glint/color/rgb.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// The part of a BSDF that a direction was sampled from.
enum class Lobe : std::uint8_t {
  Diffuse,
  Glossy,
  Specular  ///< a Dirac delta: the direction cannot be found by any other strategy
};

/// A direction drawn from a BSDF.
struct BsdfSample {
  Vec3<float> wi{0.0F, 0.0F, 1.0F};
  Rgb weight{};   ///< evaluate(wo, wi) / pdf; for a specular lobe, its reflectance over its chance
  float pdf = 0;  ///< 1/sr, of wi over all non-specular lobes; for a specular lobe, the chance that it is chosen
  Lobe lobe = Lobe::Diffuse;
  /// By what `weight` is to be multiplied where wo goes toward the light and wi toward the camera. For specular lobes
  /// only: with η the indices on the sides of wo and wi, (ηo / ηi)² times what the weight from wi to wo is of this one.
  float adjoint = 1;
};

/// How light scatters at a point. The conventions, for every BSDF of the library:
///
/// - Directions are in the shading frame, unit length, and both point away from the surface; z is the shading normal.
///   wo is given, wi is looked for. In a path tracer wo goes toward the camera and wi toward the light.
/// - `evaluate(wo, wi)` is f(wo, wi) · |cos θi|: the cosine is in. Specular lobes contribute nothing to it.
/// - `pdf(wo, wi)` is the density with which `sample` draws wi, 1/sr, specular lobes left out.
/// - `sample(wo, u, uv)` draws wi: u in [0, 1) chooses a lobe, uv in [0, 1)² a direction in it. Nothing where no light
///   is scattered. weight = evaluate / pdf.
/// - `is_specular()`: evaluate is zero for all directions, so that sampling lights is of no use.
/// - Transmitted radiance: each BSDF that transmits says whether it scales radiance by the squared index ratio.
///
/// Laws: testing/bsdf_laws.hpp.
template <typename B>
concept Bsdf = requires(const B& bsdf, const Vec3<float>& w, float u, const Vec2<float>& uv) {
  { bsdf.evaluate(w, w) } -> std::same_as<Rgb>;
  { bsdf.pdf(w, w) } -> std::same_as<float>;
  { bsdf.sample(w, u, uv) } -> std::same_as<std::optional<BsdfSample>>;
  { bsdf.is_specular() } -> std::same_as<bool>;
};

}  // namespace glint

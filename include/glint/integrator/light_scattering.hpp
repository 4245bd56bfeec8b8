// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>

#include <glm/geometric.hpp>

#include <glint/bsdf/concepts.hpp>
#include <glint/color/rgb.hpp>
#include <glint/scene/interaction.hpp>

/// Scattering on the way from a light to the camera, by BSDFs that are written for the way back. A path carries the
/// same light whichever end it was begun at, so the BSDF is asked as it would be from the camera, and what remains is a
/// change of measure by the cosines to the geometric normal. That holds for refraction, where radiance is scaled and
/// flux is not, for shading normals, and for BSDFs that are not symmetric.
///
/// Source: Veach (1997), sections 5.2 and 5.3.
namespace glint {

/// What an interaction found from the light's side, wo toward the light, sends toward the camera: intensity for each
/// unit of flux.
///
/// Requires: |to_camera| = 1; to_camera_local is it in the shading frame.
template <Bsdf B>
[[nodiscard]] Rgb scattered_flux(const Interaction<B>& at, const Vec3<float>& wo_local, const Vec3<float>& to_camera,
                                 const Vec3<float>& to_camera_local) {
  const float cos_light = std::abs(glm::dot(at.wo, at.surface.normal));
  if (!(cos_light > 0)) return {};
  const float cos_camera = std::abs(glm::dot(to_camera, at.surface.normal));
  return at.bsdf.evaluate(to_camera_local, wo_local) * (cos_camera / cos_light);
}

/// By what the flux of a light path is multiplied where it goes on in a direction drawn from the BSDF.
template <Bsdf B>
[[nodiscard]] Rgb flux_weight(const Interaction<B>& at, const Vec3<float>& wo_local, const BsdfSample& scattered,
                              const Vec3<float>& direction) {
  if (scattered.lobe != Lobe::Specular) return scattered_flux(at, wo_local, direction, scattered.wi) / scattered.pdf;
  const float before = glm::dot(at.wo, at.surface.normal) * scattered.wi.z;
  const float after = glm::dot(direction, at.surface.normal) * wo_local.z;
  return before != 0 ? scattered.weight * (scattered.adjoint * std::abs(after / before)) : Rgb{};
}

}  // namespace glint

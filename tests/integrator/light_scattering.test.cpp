// SPDX-License-Identifier: MIT
#include <glint/integrator/light_scattering.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>

namespace test_integrator_light_scattering {

using glint::Vec3;

namespace {

/// A place whose shading normal leans away from the geometric one.
template <typename B>
glint::Interaction<B> leaning(const B& bsdf, const Vec3<float>& wo) {
  const Vec3<float> shading = glm::normalize(Vec3<float>(0.3F, -0.2F, 1));
  return {
      .surface = {.shading_normal = shading}, .frame = glint::Frame<float>::around(shading), .wo = wo, .bsdf = bsdf};
}

template <typename B>
void check_weights(const B& bsdf) {
  glint::Random random{5};
  int checked = 0;
  for (int i = 0; i < 200; ++i) {
    const auto at = leaning(bsdf, glint::uniform_sphere(random.uniform_vec2()));
    const Vec3<float> wo = at.to_local(at.wo);
    const auto u = random.uniform_vec2();
    const auto s = bsdf.sample(wo, u.x, random.uniform_vec2());
    if (!s || std::abs(s->wi.z) < 0.05F || std::abs(at.wo.z) < 0.05F) continue;
    const Vec3<float> direction = at.to_world(s->wi);
    // Symmetric BSDFs change by Veach's factor alone.
    const float factor = std::abs(wo.z * direction.z) / std::abs(at.wo.z * s->wi.z);
    const float index = wo.z * s->wi.z < 0 ? (wo.z > 0 ? 1.5F * 1.5F : 1 / (1.5F * 1.5F)) : 1;  // (ηi / ηo)²
    CHECK(flux_weight(at, wo, *s, direction).g == Approx(s->weight.g * factor * index).epsilon(2e-3));
    ++checked;
  }
  CHECK(checked > 40);
}

}  // namespace

TEST_CASE("light scattering: flux is radiance but for shading normals and the squared index ratio",
          "[integrator][light_scattering]") {
  check_weights(glint::Lambertian{glint::Rgb{0.7F}});
  check_weights(glint::Dielectric{});
  check_weights(glint::RoughDielectric<glint::Ggx>{.distribution = {.alpha_x = 0.4F, .alpha_y = 0.4F}});
}

TEST_CASE("light scattering: unscaled refraction scales flux instead", "[integrator][light_scattering]") {
  const Vec3<float> wo{0.6F, 0, 0.8F};
  const glint::Interaction<glint::PerfectRefraction> at{.wo = wo};
  const auto s = at.bsdf.sample(wo, 0.5F, {});
  REQUIRE(s);
  // A path from the camera's side has weight one; the beam's étendue shrinks by 1 / 1.5² in the measure of directions.
  CHECK(flux_weight(at, wo, *s, s->wi).g == Approx(1 / 2.25));
}

TEST_CASE("light scattering: light along the surface brings nothing", "[integrator][light_scattering]") {
  const glint::Interaction<glint::Lambertian> at{.wo = {1, 0, 0}};
  CHECK(scattered_flux(at, at.wo, {0, 0, 1}, {0, 0, 1}) == glint::Rgb{0});
}

}  // namespace test_integrator_light_scattering

// SPDX-License-Identifier: MIT
#include <glint/bsdf/albedo.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/math/random.hpp>

namespace test_bsdf_albedo {

namespace {

using glint::estimated_albedo;
using glint::Rgb;
using glint::Vec3;

const Vec3<float> slanted = glm::normalize(Vec3<float>{0.6F, 0.2F, 0.7F});

/// The mean of many estimates, of green.
template <typename B>
double mean_of_estimates(const B& bsdf, const Vec3<float>& wo, int count) {
  glint::Random random(7);
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const auto u = random.uniform_vec3<float>();
    sum += static_cast<double>(estimated_albedo(bsdf, wo, u.x, {u.y, u.z}).g);
  }
  return sum / count;
}

/// ∫ f cos over the upper hemisphere by the midpoint rule, in cos² and azimuth, where the cosine's measure is even.
template <typename B>
double integral(const B& bsdf, const Vec3<float>& wo) {
  constexpr int n = 1000;
  double sum = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double cos = std::sqrt((i + 0.5) / n);
      const double sin = std::sqrt(1 - cos * cos);
      const double azimuth = 2 * 3.14159265358979 * (j + 0.5) / n;
      const Vec3<double> wi{sin * std::cos(azimuth), sin * std::sin(azimuth), cos};
      sum += static_cast<double>(bsdf.evaluate(wo, Vec3<float>(wi)).g) / cos;
    }
  }
  return sum * 3.14159265358979 / (static_cast<double>(n) * n);
}

}  // namespace

TEST_CASE("albedo: of a closed form, whatever the numbers", "[bsdf][albedo]") {
  const glint::Lambertian clay{{0.2F, 0.4F, 0.6F}};
  static_assert(glint::BsdfWithAlbedo<glint::Lambertian>);
  CHECK(estimated_albedo(clay, slanted, 0.3F, {0, 0}) == clay.reflectance);
  CHECK(estimated_albedo(clay, -slanted, 0.3F, {0, 0}) == Rgb{0});
  CHECK(integral(clay, slanted) == Approx(0.4).epsilon(1e-5));
}

TEST_CASE("albedo: estimates have the integral of the BSDF as their mean", "[bsdf][albedo]") {
  const glint::RoughConductor<glint::Ggx> metal{.distribution = {0.5F, 0.5F}};
  // Weights of GGX by visible normals are at most one, so 200 000 of them have a standard error below 1 / √200 000.
  CHECK(mean_of_estimates(metal, slanted, 200'000) == Approx(integral(metal, slanted)).margin(4 * 0.0023));
}

TEST_CASE("albedo: specular lobes count", "[bsdf][albedo]") {
  CHECK(estimated_albedo(glint::Mirror{{0.9F, 0.8F, 0.7F}}, slanted, 0, {0, 0}) == Rgb{0.9F, 0.8F, 0.7F});
  // Of a coat that loses nothing over a base that loses nothing, all light comes back.
  const glint::CoatedDiffuse enamel{.reflectance = Rgb{1}};
  CHECK(mean_of_estimates(enamel, slanted, 200'000) == Approx(1).margin(0.01));
  // Glass lets in what it does not reflect, with radiance scaled by 1 / η².
  const glint::Dielectric glass{};
  const double reflected = static_cast<double>(glint::fresnel_dielectric(slanted.z, 1 / glass.eta));
  CHECK(mean_of_estimates(glass, slanted, 200'000) == Approx(reflected + (1 - reflected) / 2.25).margin(0.005));
}

TEST_CASE("albedo: of the BSDF that is held", "[bsdf][albedo]") {
  using Either = glint::OneOf<glint::Lambertian, glint::Mirror>;
  CHECK(estimated_albedo(Either{glint::Mirror{Rgb{0.5F}}}, slanted, 0, {0, 0}) == Rgb{0.5F});
  CHECK(estimated_albedo(Either{glint::Lambertian{Rgb{0.3F}}}, slanted, 0, {0, 0}) == Rgb{0.3F});
}

}  // namespace test_bsdf_albedo

// SPDX-License-Identifier: MIT
#include <glint/bsdf/microfacet_albedo.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <support/catch.hpp>

#include <glint/bsdf/fresnel.hpp>

namespace test_bsdf_microfacet_albedo {

using glint::Beckmann;
using glint::DirectionalAlbedo;
using glint::Ggx;
using glint::Vec3;

namespace {

/// What leaves after one bounce, by the midpoint rule in the random numbers of visible normals.
template <typename Distribution, typename Fresnel>
double reflected(const Distribution& d, float cos, const Fresnel& fresnel) {
  constexpr int steps = 100;
  const Vec3<float> wo{std::sqrt(1 - cos * cos), 0.0F, cos};
  const float area = d.projected_area(wo);
  double sum = 0;
  for (int i = 0; i < steps * steps; ++i) {
    const glint::Vec2<float> uv{(float(i % steps) + 0.5F) / steps, (float(i / steps) + 0.5F) / steps};
    const Vec3<float> m = d.sample_visible(wo, uv);
    const Vec3<float> wi = glint::reflect(wo, m);
    if (wi.z > 0) sum += double{shared_visibility(d, wo, wi, area) * fresnel(glm::dot(wo, m))};
  }
  return sum / (steps * steps);
}

}  // namespace

TEMPLATE_TEST_CASE("microfacet_albedo: the tables hold what one bounce loses and reflects", "[bsdf][microfacet_albedo]",
                   Ggx, Beckmann) {
  for (const float alpha : {0.05F, 0.2F, 0.45F, 1.0F}) {
    const TestType d{alpha, alpha};
    for (const float cos : {0.06F, 0.3F, 0.7F, 1.0F}) {
      CAPTURE(alpha, cos);
      CHECK(DirectionalAlbedo{d}.missing(cos) ==
            Approx(1 - reflected(d, cos, [](float) { return 1.0F; })).margin(0.01));
      const double glass = reflected(d, cos, [](float c) { return glint::fresnel_dielectric(c, 1 / 1.5F); });
      CHECK(DirectionalAlbedo{d}.dielectric(cos, 0.04F) == Approx(glass).margin(0.01));
    }
  }
}

TEMPLATE_TEST_CASE("microfacet_albedo: means are those of the interpolated tables", "[bsdf][microfacet_albedo]", Ggx,
                   Beckmann) {
  const DirectionalAlbedo albedo{TestType{0.4F, 0.4F}};
  double missing = 0;
  double glass = 0;
  for (int i = 0; i < 2000; ++i) {
    const float cos = (float(i) + 0.5F) / 2000;
    missing += 1e-3 * double{cos * albedo.missing(cos)};
    glass += 1e-3 * double{cos * albedo.dielectric(cos, 0.04F)};
  }
  CHECK(albedo.mean_missing() == Approx(missing).epsilon(1e-4));
  CHECK(albedo.mean_dielectric(0.04F) == Approx(glass).epsilon(1e-4));
}

}  // namespace test_bsdf_microfacet_albedo

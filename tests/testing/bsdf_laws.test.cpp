// SPDX-License-Identifier: MIT
#include <glint/testing/bsdf_laws.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>

namespace test_testing_bsdf_laws {

using glint::BsdfSample;
using glint::Dielectric;
using glint::Lambertian;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;
using glint::testing::SeenFrom;
using glint::testing::violations_of_bsdf_laws;

namespace {

/// A sound BSDF, to be broken in one place.
struct Sound {
  Lambertian base{{0.8F}};
  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const { return base.evaluate(wo, wi); }
  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const { return base.pdf(wo, wi); }
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const {
    return base.sample(wo, u, uv);
  }
  [[nodiscard]] static bool is_specular() { return false; }
};

/// Samples changed by a function.
template <typename Change>
struct Resampled : Sound {
  Change change;
  [[nodiscard]] std::optional<BsdfSample> sample(const Vec3<float>& wo, float u, const Vec2<float>& uv) const {
    auto s = base.sample(wo, u, uv);
    if (s) change(wo, *s);
    return s;
  }
};

template <typename Change>
std::vector<std::string> violations_when(Change change) {
  return violations_of_bsdf_laws(Resampled<Change>{{}, change}, 1);
}

bool has(const std::vector<std::string>& violations, const std::string& law) {
  return std::any_of(violations.begin(), violations.end(),
                     [&](const std::string& v) { return v.find(law) != std::string::npos; });
}

struct ForgotCosine : Sound {
  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return wo.z > 0 && wi.z > 0 ? base.reflectance * glint::inv_pi<float> : Rgb{};
  }
};

struct OneWay : Sound {
  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return base.evaluate(wo, wi) * wo.z;
  }
};

struct Unreachable : Sound {
  [[nodiscard]] Rgb evaluate(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return wo.z * wi.z < 0 ? Rgb{0.1F} : base.evaluate(wo, wi);
  }
};

struct WrongDensity : Sound {
  [[nodiscard]] float pdf(const Vec3<float>& wo, const Vec3<float>& wi) const {
    return wo.z > 0 && wi.z > 0 ? 0.5F * glint::inv_pi<float> : 0.0F;
  }
};

struct SpecularInName : Sound {
  [[nodiscard]] static bool is_specular() { return true; }
};

}  // namespace

TEST_CASE("bsdf_laws: a sound BSDF breaks none", "[testing][bsdf_laws]") {
  CHECK(violations_of_bsdf_laws(Sound{}, 1, {.seen_from = SeenFrom::Front, .least_albedo = 0.8F}).empty());
}

TEST_CASE("bsdf_laws: a value without its cosine is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(ForgotCosine{}, 1), "weight is evaluate over pdf"));
}

TEST_CASE("bsdf_laws: light that goes one way only is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(OneWay{}, 1), "light goes both ways alike"));
}

TEST_CASE("bsdf_laws: light where samples never go is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(Unreachable{}, 1), "where light is scattered, samples may go"));
}

TEST_CASE("bsdf_laws: a density that samples do not have is found", "[testing][bsdf_laws]") {
  const auto violations = violations_of_bsdf_laws(WrongDensity{}, 1);
  CHECK(has(violations, "pdf is the density of the sample"));
  CHECK(has(violations, "samples are distributed as pdf says"));
}

TEST_CASE("bsdf_laws: light made from nothing is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(Lambertian{{1.1F}}, 1), "no more light leaves than arrives"));
  CHECK(has(violations_of_bsdf_laws(glint::Mirror{{1.1F}}, 1), "no more light leaves than arrives"));
}

TEST_CASE("bsdf_laws: light lost against the promise is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(Lambertian{{0.9F}}, 1, {.seen_from = SeenFrom::Front, .least_albedo = 1}),
            "no less light leaves than promised"));
}

TEST_CASE("bsdf_laws: an undeclared scaling of radiance is found", "[testing][bsdf_laws]") {
  CHECK(has(violations_of_bsdf_laws(Dielectric{}, 1), "no more light leaves than arrives"));
  CHECK(has(violations_of_bsdf_laws(Dielectric{}, 1), "specular light goes both ways alike"));
}

TEST_CASE("bsdf_laws: a BSDF seen from behind against the promise is found", "[testing][bsdf_laws]") {
  const auto violations =
      violations_of_bsdf_laws(Dielectric{}, 1, {.seen_from = SeenFrom::Front, .radiance_eta = 1.5F});
  CHECK(has(violations, "nothing is sampled from behind"));
}

TEST_CASE("bsdf_laws: a specular BSDF with values is found", "[testing][bsdf_laws]") {
  const auto violations = violations_of_bsdf_laws(SpecularInName{}, 1);
  CHECK(has(violations, "specular BSDFs evaluate to zero"));
  CHECK(has(violations, "specular BSDFs have specular lobes alone"));
}

TEST_CASE("bsdf_laws: bad samples are found", "[testing][bsdf_laws]") {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  CHECK(has(violations_when([](const Vec3<float>&, BsdfSample& s) { s.wi *= 1.01F; }), "unit length"));
  CHECK(has(violations_when([](const Vec3<float>&, BsdfSample& s) { s.wi.x = nan; }), "unit length"));
  CHECK(
      has(violations_when([](const Vec3<float>& wo, BsdfSample& s) { s.weight = wo.z < 0.01F ? Rgb{nan} : s.weight; }),
          "weights are finite"));
  CHECK(has(violations_when([](const Vec3<float>& wo, BsdfSample& s) { s.pdf = wo.z < 0.01F ? 0.0F : s.pdf; }),
            "densities of samples are finite and positive"));
  CHECK(has(violations_when([](const Vec3<float>&, BsdfSample& s) { s.wi.x = -std::abs(s.wi.x); }),
            "samples are distributed as pdf says"));
}

}  // namespace test_testing_bsdf_laws

// SPDX-License-Identifier: MIT
#include <glint/bsdf/fresnel.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <complex>

#include <nlohmann/json.hpp>
#include <support/catch.hpp>
#include <support/shared.hpp>

#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>

namespace test_bsdf_fresnel {

using glint::Rgb;
using glint::Vec3;

TEMPLATE_TEST_CASE("fresnel: reflecting twice gives the direction back", "[bsdf][fresnel]", float, double) {
  using T = TestType;
  glint::Random random{1};
  for (int i = 0; i < 100; ++i) {
    const Vec3<T> n = glint::uniform_sphere(random.uniform_vec2<T>());
    const Vec3<T> wo = glint::uniform_sphere(random.uniform_vec2<T>());
    const Vec3<T> back = glint::reflect(glint::reflect(wo, n), n);
    CHECK(glint::length_squared(back - wo) < T(1e-11));  // a few roundings of 6e-8, squared
    CHECK(glm::dot(glint::reflect(wo, n), n) == Approx(glm::dot(wo, n)).margin(1e-6));
  }
}

TEMPLATE_TEST_CASE("fresnel: refracted directions obey Snell's law in the plane of incidence", "[bsdf][fresnel]", float,
                   double) {
  using T = TestType;
  glint::Random random{2};
  for (int i = 0; i < 200; ++i) {
    const Vec3<T> n = glint::uniform_sphere(random.uniform_vec2<T>());
    Vec3<T> wo = glint::uniform_sphere(random.uniform_vec2<T>());
    if (glm::dot(wo, n) < T(0)) wo = -wo;
    const T eta = random.uniform(T(0.5), T(2));
    const auto wi = glint::refract(wo, n, eta);
    const Vec3<T> sine_o = glm::cross(n, wo);
    const T transmitted = eta * eta * glint::length_squared(sine_o);
    if (std::abs(transmitted - T(1)) < T(1e-4)) continue;  // rounding decides
    REQUIRE(wi.has_value() == (transmitted < T(1)));
    if (!wi) continue;
    CHECK(glm::length(*wi) == Approx(1).margin(1e-5));
    CHECK(glm::dot(*wi, n) < T(0));
    // Snell as vectors: n × wi = −eta (n × wo), which holds the plane and the sine at once.
    CHECK(glint::length_squared(glm::cross(n, *wi) + eta * sine_o) < T(1e-10));
  }
}

TEST_CASE("fresnel: the critical angle itself is total internal reflection", "[bsdf][fresnel]") {
  CHECK_FALSE(glint::refracted_cos(0.25, 2.0));  // 2² · 0.25 = 1, exact
  CHECK_FALSE(glint::refracted_cos(0.25F, 2.0F));
  CHECK(glint::refracted_cos(0.2499, 2.0));
  CHECK_FALSE(glint::refracted_cos(std::nan(""), 2.0));
}

TEMPLATE_TEST_CASE("fresnel: refract agrees with the reference vectors", "[bsdf][fresnel][vectors]", float, double) {
  using T = TestType;
  const auto text = glint::testing::shared_file("vectors/refract.json");
  if (!text) return;
  const auto data = nlohmann::json::parse(*text);
  const auto vec3 = [](const nlohmann::json& v) {
    return Vec3<T>{v.at(0).get<T>(), v.at(1).get<T>(), v.at(2).get<T>()};
  };
  REQUIRE(data.at("cases").size() > 0);
  for (const auto& c : data.at("cases")) {
    CAPTURE(c.dump());
    const Vec3<T> wo = vec3(c.at("wo"));
    const Vec3<T> n = vec3(c.at("n"));
    const auto wi = glint::refract(wo, n, c.at("eta_ratio").get<T>());
    CHECK(wi.has_value() == !c.at("tir").get<bool>());
    const Vec3<T> answer = wi ? *wi : glint::reflect(wo, n);
    CHECK(glm::length(answer - vec3(c.at("wi"))) <= data.at("tolerance").get<T>());
  }
}

TEMPLATE_TEST_CASE("fresnel: at normal incidence a dielectric reflects ((n − 1) / (n + 1))²", "[bsdf][fresnel]", float,
                   double) {
  using T = TestType;
  for (const T n : {T(1), T(1.33), T(1.5), T(2.4)}) {
    const T expected = ((n - 1) / (n + 1)) * ((n - 1) / (n + 1));
    CHECK(glint::fresnel_dielectric(T(1), T(1) / n) == Approx(expected).margin(1e-7));
    CHECK(glint::fresnel_dielectric(T(1), n) == Approx(expected).margin(1e-7));  // the same from inside
  }
}

TEST_CASE("fresnel: at Brewster's angle only light polarized across the plane is reflected", "[bsdf][fresnel]") {
  // tan θ = n: cos θ = 1 / √(1 + n²), cos θt = n / √(1 + n²); the parallel amplitude is zero, the other is
  // (1 − n²) / (1 + n²), and half the light has that polarization.
  const double n = 1.5;
  const double amplitude = (1 - n * n) / (1 + n * n);
  CHECK(glint::fresnel_dielectric(1 / std::sqrt(1 + n * n), 1 / n) == Approx(0.5 * amplitude * amplitude));
}

TEST_CASE("fresnel: a dielectric reflects everything at grazing incidence and beyond the critical angle",
          "[bsdf][fresnel]") {
  CHECK(glint::fresnel_dielectric(0.0F, 1 / 1.5F) == 1.0F);
  CHECK(glint::fresnel_dielectric(0.0F, 1.5F) == 1.0F);
  CHECK(glint::fresnel_dielectric(0.5, 1.5) == 1.0);  // sin = 0.866 > 1 / 1.5
  CHECK(glint::fresnel_dielectric(0.75, 1.5) < 1.0);  // sin = 0.661 < 1 / 1.5
  CHECK(glint::fresnel_dielectric(0.5, 1.0) == 0.0);  // no interface
}

TEST_CASE("fresnel: a dielectric reflects alike from both ends of a refracted path", "[bsdf][fresnel]") {
  for (int i = 1; i <= 50; ++i) {
    const double cos_o = i / 50.0;
    const auto cos_i = glint::refracted_cos(1 - cos_o * cos_o, 1 / 1.5);
    REQUIRE(cos_i);
    CHECK(glint::fresnel_dielectric(cos_o, 1 / 1.5) == Approx(glint::fresnel_dielectric(*cos_i, 1.5)));
  }
}

TEST_CASE("fresnel: a conductor that absorbs nothing is a dielectric", "[bsdf][fresnel]") {
  for (const double n : {0.7, 1.0, 1.5, 3.0}) {  // 0.7: with total internal reflection
    for (int i = 0; i <= 50; ++i) {
      const double cos = i / 50.0;
      CAPTURE(n, cos);
      if (n == 1.0 && i == 0) continue;  // no interface, seen edge-on: the limit depends on the way
      CHECK(glint::fresnel_conductor(cos, n, 0.0) == Approx(glint::fresnel_dielectric(cos, 1 / n)).margin(1e-12));
    }
  }
}

TEMPLATE_TEST_CASE("fresnel: a conductor's share is that of the complex amplitudes", "[bsdf][fresnel]", float, double) {
  using T = TestType;
  using Complex = std::complex<double>;
  for (const Complex index : {Complex{0.2, 3.9}, Complex{1.1, 2.6}, Complex{1.0, 1.0}, Complex{4.0, 0.05}}) {
    for (int i = 0; i <= 20; ++i) {
      const double cos = i / 20.0;
      CAPTURE(index, cos);
      const Complex inside = std::sqrt(1.0 - (1 - cos * cos) / (index * index));  // Snell's law with a complex index
      const Complex perpendicular = (cos - index * inside) / (cos + index * inside);
      const Complex parallel = (index * cos - inside) / (index * cos + inside);
      const double expected = 0.5 * (std::norm(perpendicular) + std::norm(parallel));
      CHECK(glint::fresnel_conductor(T(cos), T(index.real()), T(index.imag())) == Approx(expected).epsilon(2e-6));
    }
  }
}

TEST_CASE("fresnel: a conductor's colors are computed one by one", "[bsdf][fresnel]") {
  const Rgb eta{0.2F, 0.9F, 1.1F};
  const Rgb k{3.9F, 2.5F, 2.1F};
  const Rgb share = glint::fresnel_conductor(0.6F, eta, k);
  CHECK(share.r == Approx(glint::fresnel_conductor(0.6F, eta.r, k.r)).epsilon(1e-6));
  CHECK(share.g == Approx(glint::fresnel_conductor(0.6F, eta.g, k.g)).epsilon(1e-6));
  CHECK(share.b == Approx(glint::fresnel_conductor(0.6F, eta.b, k.b)).epsilon(1e-6));
}

TEST_CASE("fresnel: Schlick's approximation goes from the share at normal incidence to one", "[bsdf][fresnel]") {
  CHECK(glint::fresnel_schlick(1.0, 0.04) == 0.04);
  CHECK(glint::fresnel_schlick(0.0, 0.04) == 1.0);
  CHECK(glint::fresnel_schlick(0.5, 0.04) == Approx(0.04 + 0.96 / 32));  // (1 − 0.5)⁵ = 1/32
  const Rgb gold = glint::fresnel_schlick(0.5F, Rgb{1.0F, 0.04F, 0.0F});
  CHECK(gold.r == 1.0F);
  CHECK(gold.g == Approx(0.07F));
  CHECK(gold.b == Approx(1 / 32.0F));
}

}  // namespace test_bsdf_fresnel

// SPDX-License-Identifier: MIT
#include <glint/bsdf/perfect_refraction.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include <nlohmann/json.hpp>
#include <support/catch.hpp>
#include <support/shared.hpp>

#include <glint/math/frame.hpp>
#include <glint/testing/bsdf_laws.hpp>

namespace test_bsdf_perfect_refraction {

using glint::PerfectRefraction;
using glint::Rgb;
using glint::Vec3;

namespace {

/// The direction in which light travels on after meeting the surface, against the stream: from the camera on.
Vec3<float> onward(const PerfectRefraction& bsdf, const Vec3<float>& normal, const Vec3<float>& direction) {
  const auto frame = glint::Frame<float>::around(normal);
  const auto s = bsdf.sample(frame.to_local(-direction), 0.5F, {0.5F, 0.5F});
  REQUIRE(s);
  return frame.to_world(s->wi);
}

/// Where a line from a point of the unit sphere around the origin leaves it: p + t d, t = −2 p · d.
Vec3<float> across_unit_sphere(const Vec3<float>& p, const Vec3<float>& d) {
  return p - d * (2 * glm::dot(p, d));
}

}  // namespace

TEST_CASE("perfect_refraction: light enters and leaves by Snell's law, undimmed", "[bsdf][perfect_refraction]") {
  const PerfectRefraction bsdf{.eta = 1.5F};
  const auto in = bsdf.sample({0.6F, 0.0F, 0.8F}, 0.5F, {0.5F, 0.5F});
  REQUIRE(in);
  CHECK(in->wi.x == Approx(-0.4));  // sin 0.6 / 1.5
  CHECK(in->wi.z == Approx(-std::sqrt(1 - 0.16)));
  CHECK(in->weight == Rgb{1});
  CHECK(in->lobe == glint::Lobe::Specular);
  const auto out = bsdf.sample({0.4F, 0.0F, -std::sqrt(1 - 0.16F)}, 0.5F, {0.5F, 0.5F});
  REQUIRE(out);
  CHECK(out->wi.x == Approx(-0.6));
  CHECK(out->wi.z == Approx(0.8));
  CHECK(out->weight == Rgb{1});
}

TEST_CASE("perfect_refraction: beyond the critical angle it is a mirror", "[bsdf][perfect_refraction]") {
  const auto inside = PerfectRefraction{.eta = 1.5F}.sample({0.8F, 0.0F, -0.6F}, 0.5F, {0.5F, 0.5F});  // 0.8 · 1.5 > 1
  REQUIRE(inside);
  CHECK(inside->wi == Vec3<float>{-0.8F, 0.0F, -0.6F});
  CHECK(inside->weight == Rgb{1});
  const auto outside = PerfectRefraction{.eta = 0.5F}.sample({0.6F, 0.0F, 0.8F}, 0.5F, {0.5F, 0.5F});  // 0.6 / 0.5 > 1
  REQUIRE(outside);
  CHECK(outside->wi == Vec3<float>{-0.6F, 0.0F, 0.8F});
}

TEST_CASE("perfect_refraction: a closed sphere turns the view over", "[bsdf][perfect_refraction]") {
  // A ray at height h meets the unit sphere at sin θ = h. It is turned toward the axis by θ − θ' on entering and, the
  // triangle of chord and radii being isosceles, by as much again on leaving; sin θ' = h / 1.5.
  const PerfectRefraction bsdf{.eta = 1.5F};
  for (const float h : {-0.7F, -0.3F, 0.05F, 0.4F, 0.8F}) {
    CAPTURE(h);
    const Vec3<float> entry{h, 0.0F, std::sqrt(1 - h * h)};
    const Vec3<float> within = onward(bsdf, entry, {0.0F, 0.0F, -1.0F});
    const Vec3<float> exit = across_unit_sphere(entry, within);
    const Vec3<float> beyond = onward(bsdf, exit, within);
    const double turn = 2 * (std::asin(double{h}) - std::asin(double{h} / 1.5));
    CHECK(beyond.x == Approx(-std::sin(turn)).margin(1e-5));
    CHECK(beyond.y == Approx(0).margin(1e-6));
    CHECK(beyond.z == Approx(-std::cos(turn)).margin(1e-5));
    const float far = exit.x + beyond.x * 100;  // the upper ray ends below, the lower one above
    CHECK(far * h < 0);
  }
}

TEST_CASE("perfect_refraction: a slab shifts the view and does not turn it", "[bsdf][perfect_refraction]") {
  // Through thickness 2 at sin θ = 0.6, sin θ' = 0.4: the exit is 2 tan θ' aside, where 2 tan θ straight on.
  const PerfectRefraction bsdf{.eta = 1.5F};
  const Vec3<float> direction{0.6F, 0.0F, -0.8F};
  const Vec3<float> within = onward(bsdf, {0.0F, 0.0F, 1.0F}, direction);
  const Vec3<float> exit = within * (-2.0F / within.z);
  const Vec3<float> beyond = onward(bsdf, {0.0F, 0.0F, -1.0F}, within);
  CHECK(exit.x == Approx(2 * 0.4 / std::sqrt(1 - 0.16)));
  CHECK(glm::length(beyond - direction) < 1e-6F);
}

TEST_CASE("perfect_refraction: agrees with the reference vectors", "[bsdf][perfect_refraction][vectors]") {
  const auto text = glint::testing::shared_file("vectors/refract.json");
  if (!text) return;
  const auto data = nlohmann::json::parse(*text);
  for (const auto& c : data.at("cases")) {
    CAPTURE(c.dump());
    if (c.at("n") != nlohmann::json::array({0, 0, 1})) continue;
    const auto wo = c.at("wo").get<std::array<float, 3>>();
    const auto wi = c.at("wi").get<std::array<float, 3>>();
    const PerfectRefraction bsdf{.eta = 1.0F / c.at("eta_ratio").get<float>()};
    const auto s = bsdf.sample({wo[0], wo[1], wo[2]}, 0.5F, {0.5F, 0.5F});
    REQUIRE(s);
    CHECK(glm::length(s->wi - Vec3<float>{wi[0], wi[1], wi[2]}) <= data.at("tolerance").get<float>());
  }
}

TEST_CASE("perfect_refraction: obeys the laws of Bsdf, without loss", "[bsdf][perfect_refraction][laws]") {
  const float eta = GENERATE(0.6F, 1.0F, 1.5F, 2.4F);
  CAPTURE(eta);
  CHECK(PerfectRefraction{eta}.is_specular());
  CHECK(glint::testing::violations_of_bsdf_laws(PerfectRefraction{eta}, 1, {.least_albedo = 1}).empty());
}

}  // namespace test_bsdf_perfect_refraction

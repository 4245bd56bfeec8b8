// SPDX-License-Identifier: MIT
#include <glint/light/area.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <optional>

#include <support/catch.hpp>

#include <glint/geometry/disk.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/light_laws.hpp>
#include <glint/texture/constant.hpp>

namespace test_light_area {

using glint::AreaLight;
using glint::Disk;
using glint::Quad;
using glint::Rgb;
using glint::Sphere;
using glint::Surface;
using glint::Triangle;
using glint::Vec3;

namespace {

/// Irradiance on a surface at `from` with the given normal, by sampling the light.
template <typename L>
double irradiance(const L& light, const Vec3<float>& from, const Vec3<float>& normal, int samples) {
  glint::Random random{3};
  double sum = 0;
  for (int i = 0; i < samples; ++i) {
    const auto sample = light.sample(from, random.uniform_vec2());
    if (!sample) continue;
    const float cosine = std::max(0.0F, glm::dot(sample->wi, normal));
    sum += static_cast<double>(sample->radiance.r * cosine / sample->pdf);
  }
  return sum / samples;
}

/// The surface of a shape where a ray meets it.
template <typename S>
auto finder(const S& shape) {
  return [&shape](const glint::Ray<float>& ray) -> std::optional<Surface> {
    const auto hit = intersect(ray, shape);
    if (!hit) return std::nullopt;
    const Vec3<float> position = ray.origin + ray.direction * hit->t;
    if constexpr (requires { surface(shape, position, *hit); }) {
      return surface(shape, position, *hit);
    } else {
      return surface(shape, position);
    }
  };
}

template <typename S>
void check_laws(const S& shape, const Vec3<float>& from) {
  const AreaLight light{shape, Rgb{1, 2, 3}};
  const auto violations = glint::testing::violations_of_surface_light_laws(light, finder(shape), from, 1);
  for (const auto& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

}  // namespace

static_assert(glint::SurfaceLight<AreaLight<Quad<float>>> && !glint::InfiniteLight<AreaLight<Quad<float>>>);

TEST_CASE("area light: a disk overhead gives π L sin² of its angular radius", "[light][area]") {
  const AreaLight light{Disk<float>{.center = {0, 0, 2}, .normal = {0, 0, -1}, .radius = 1.5F}, Rgb{3}};
  // sin² = 1.5² / (1.5² + 2²) = 0.36
  CHECK(irradiance(light, {0, 0, 0}, {0, 0, 1}, 100'000) == Approx(3 * 0.36 * glint::pi<double>).epsilon(0.005));
}

TEST_CASE("area light: a sphere overhead gives π L (r / d)²", "[light][area]") {
  const AreaLight light{Sphere<float>{.center = {0, 0, 5}, .radius = 2}, Rgb{1}};
  CHECK(irradiance(light, {0, 0, 0}, {0, 0, 1}, 400'000) == Approx(glint::pi<double> * 0.16).epsilon(0.01));
}

TEST_CASE("area light: a rectangle gives Lambert's polygon irradiance", "[light][area]") {
  // Lambert: E = L/2 Σ θᵢ (γᵢ · n) over the edges, θ the angle an edge subtends and γ the normal of its plane.
  const Quad<float> quad{.origin = {-0.5F, 0.25F, 1.5F}, .edge_u = {0, 2, 0.5F}, .edge_v = {1, 0.5F, 0}};
  const Vec3<double> corners[] = {Vec3<double>(quad.origin), Vec3<double>(quad.origin + quad.edge_u),
                                  Vec3<double>(quad.origin + quad.edge_u + quad.edge_v),
                                  Vec3<double>(quad.origin + quad.edge_v)};
  double expected = 0;
  for (int i = 0; i < 4; ++i) {
    const Vec3<double> a = glm::normalize(corners[i]);
    const Vec3<double> b = glm::normalize(corners[(i + 1) % 4]);
    expected += 0.5 * std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).z;
  }
  CHECK(irradiance(AreaLight{quad, Rgb{1}}, {0, 0, 0}, {0, 0, 1}, 200'000) ==
        Approx(std::abs(expected)).epsilon(0.005));
}

TEST_CASE("area light: only the normal's side shines", "[light][area]") {
  const AreaLight light{Quad<float>{}, Rgb{2}};  // normal +z
  CHECK(light.sample({0.5F, 0.5F, 1}, {0.5F, 0.5F}));
  CHECK_FALSE(light.sample({0.5F, 0.5F, -1}, {0.5F, 0.5F}));
  CHECK(light.emission(Surface{}, {0, 0, 1}) == Rgb{2});
  CHECK(light.emission(Surface{}, {0, 0.6F, -0.8F}) == Rgb{0});
}

TEST_CASE("area light: the density of a point is the one its sample states", "[light][area]") {
  const AreaLight light{Disk<float>{.center = {1, 2, 3}, .normal = {0, -1, -1}, .radius = 2}, Rgb{1}};
  glint::Random random{5};
  const Vec3<float> from{0.5F, -1, 0};
  for (int i = 0; i < 100; ++i) {
    const auto u = random.uniform_vec2();
    const auto sample = light.sample(from, u);
    REQUIRE(sample);
    CHECK(light.pdf(from, sample_area(light.shape, u).surface) == Approx(sample->pdf).epsilon(1e-4));
  }
}

TEST_CASE("area light: the power of a surface is π L times its area", "[light][area]") {
  const AreaLight light{Quad<float>{.edge_u = {2, 0, 0}, .edge_v = {0, 3, 0}}, Rgb{1, 2, 3}};
  CHECK(light.power({}).b == Approx(3 * 6 * glint::pi<float>));
}

TEST_CASE("area light: a shadow ray ends before the light's own surface", "[light][area]") {
  const AreaLight light{Quad<float>{.origin = {-1, -1, 3}, .edge_u = {0, 2, 0}, .edge_v = {2, 0, 0}}, Rgb{1}};
  glint::Random random{9};
  for (int i = 0; i < 1000; ++i) {
    const auto sample = light.sample({0, 0, 0}, random.uniform_vec2());
    REQUIRE(sample);
    const glint::Ray<float> shadow{.direction = sample->target, .t_max = 1};
    CHECK_FALSE(intersect(shadow, light.shape));
  }
}

TEST_CASE("area light: obeys the laws of SurfaceLight, near and far", "[light][area][laws]") {
  check_laws(Quad<float>{}, {0.2F, 0.3F, 0.5F});
  check_laws(Quad<float>{.origin = {-9, -7, -3}, .edge_u = {20, 0, 0}, .edge_v = {0, 20, 0}}, {0, 0, 0});
  check_laws(Quad<float>{.origin = {0, 0, -1}, .edge_u = {3, 1, 0}, .edge_v = {0, 2, 0.5F}}, {0, 0, 0.5F});  // skew
  check_laws(Disk<float>{.normal = {0.2F, 0, 1}, .radius = 2}, {1, 0.3F, 0.5F});
  check_laws(Sphere<float>{.center = {0, 1, 3}, .radius = 0.5F}, {0, 0, 1});
  check_laws(Sphere<float>{.center = {0, 1, 3}, .radius = 3}, {0, 0, 0});
  check_laws(Triangle<float>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}, {0.5F, 1, 0.2F});
  check_laws(Triangle<float>{{0, 0, 0}, {2, 0, 0}, {0, 2, 0.5F}}, {0.5F, 1, 3});
}

TEST_CASE("area light: shines as its texture says at each point", "[light][area]") {
  // A ramp from black to white along u: what it gives off is the mean, a half, and half of the square has 3/4 of it.
  struct Ramp {
    Rgb evaluate(const glint::Vec2<float>& uv) const { return Rgb{uv.x}; }
  };
  const AreaLight light{Quad<float>{}, Ramp{}};
  static_assert(glint::SurfaceLight<decltype(light)> && glint::BoundedLight<decltype(light)>);
  CHECK(light.emission(Surface{.uv = {0.75F, 0}}, {0, 0, 1}) == Rgb{0.75F});
  CHECK(light.power({}).g == Approx(0.5F * glint::pi<float>));
  const auto sample = light.sample({0.4F, 0.5F, 9}, {0.25F, 0.5F});
  REQUIRE(sample);
  CHECK(sample->radiance.r == Approx(0.25F));
  CHECK(glint::testing::violations_of_surface_light_laws(light, finder(light.shape), {0.5F, 0.5F, 0.4F}, 1).empty());
  CHECK(glint::testing::violations_of_emission_laws(light, {}, 1).empty());
}

TEST_CASE("area light: a black texture still may hide light", "[light][area]") {
  const AreaLight light{Quad<float>{}, glint::ConstantTexture{Rgb{0}}};
  CHECK(light.power({}).r > 0);
}

TEST_CASE("area light: flat shapes shine in the half space before them", "[light][area]") {
  const glint::LightBounds quad = AreaLight{Quad<float>{}, Rgb{3}}.light_bounds();
  CHECK(quad.box == glint::Aabb<float>{{0, 0, 0}, {1, 1, 0}});
  CHECK(quad.axis == Vec3<float>{0, 0, 1});
  CHECK(quad.cos_theta_o == 1);
  CHECK(quad.cos_theta_e == 0);
  CHECK(quad.intensity == Approx(3));
  CHECK(AreaLight{Sphere<float>{}, Rgb{1}}.light_bounds().cos_theta_o == -1);
}

}  // namespace test_light_area

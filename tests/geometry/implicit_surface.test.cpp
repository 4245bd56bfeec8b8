// SPDX-License-Identifier: MIT
#include <glint/geometry/implicit_surface.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/solids.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/primitive_laws.hpp>
#include <glint/testing/random_rays.hpp>

namespace test_geometry_implicit_surface {

namespace {

using glint::Aabb;
using glint::ImplicitSurface;
using glint::Ray;
using glint::Vec3;

struct Ball {
  double radius = 1;
  template <typename T>
  [[nodiscard]] T operator()(const Vec3<T>& p) const {
    return glm::length(p) - T(radius);
  }
};

/// Around z.
struct Torus {
  double major = 1;
  double minor = 0.35;
  template <typename T>
  [[nodiscard]] T operator()(const Vec3<T>& p) const {
    const T ring = std::hypot(p.x, p.y) - T(major);
    return std::hypot(ring, p.z) - T(minor);
  }
};

/// Hills; not a distance: it changes by up to √(1 + 2 · 0.6²) < 1.4 a unit of length.
struct Hills {
  template <typename T>
  [[nodiscard]] T operator()(const Vec3<T>& p) const {
    return p.y - T(0.2) * std::sin(T(3) * p.x) * std::sin(T(3) * p.z);
  }
  template <typename T>
  [[nodiscard]] Vec3<T> gradient(const Vec3<T>& p) const {
    return {T(-0.6) * std::cos(T(3) * p.x) * std::sin(T(3) * p.z), 1,
            T(-0.6) * std::sin(T(3) * p.x) * std::cos(T(3) * p.z)};
  }
};

template <typename T>
Aabb<T> cube(double reach) {
  return {Vec3<T>(T(-reach)), Vec3<T>(T(reach))};
}

}  // namespace

static_assert(glint::ShadablePrimitive<ImplicitSurface<float, Torus>> &&
              glint::ShadablePrimitive<ImplicitSurface<double, Hills>>);

TEMPLATE_TEST_CASE("implicit surface: it obeys the laws of Primitive", "[geometry][implicit_surface][laws]", float,
                   double) {
  using T = TestType;
  const auto violations = [](const auto& shape) { return glint::testing::violations_of_primitive_laws(shape, 1); };
  CHECK(violations(ImplicitSurface{cube<T>(1.25), Ball{}}) == std::vector<std::string>{});
  CHECK(violations(ImplicitSurface{cube<T>(1.5), Torus{}}) == std::vector<std::string>{});
  CHECK(violations(ImplicitSurface{cube<T>(2), Hills{}, T(1.4)}) == std::vector<std::string>{});
  CHECK(violations(ImplicitSurface{Aabb<T>{}, Ball{}}) == std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("implicit surface: a ball is met where the sphere is", "[geometry][implicit_surface]", float,
                   double) {
  using T = TestType;
  const ImplicitSurface ball{cube<T>(1.25), Ball{}};
  const glint::Sphere<T> sphere{.center = {0, 0, 0}, .radius = 1};
  int hits = 0;
  for (const Ray<T>& ray : glint::testing::rays_into(bounds(ball), 2000, 7)) {
    const auto expected = intersect(ray, sphere);
    const auto hit = intersect(ray, ball);
    if (!expected || !hit) {  // a ray that leaves the ball after less than the least step may miss it
      const T middle = -glm::dot(ray.origin, ray.direction) / glm::dot(ray.direction, ray.direction);
      if (hit.has_value() != expected.has_value()) REQUIRE(std::abs(glm::length(ray.at(middle)) - T(1)) < T(1e-5));
      continue;
    }
    ++hits;
    const T slack = T(64) * std::numeric_limits<T>::epsilon() * glm::length(ray.origin);
    const Vec3<T> normal = glm::normalize(ray.at(expected->t));
    const T facing = std::abs(glm::dot(normal, glm::normalize(ray.direction)));
    REQUIRE(glm::length(ray.direction) * std::abs(hit->t - expected->t) * facing < T(4) * slack);
    const auto at = surface(ball, ray.at(hit->t));
    REQUIRE(glm::length(at.normal - normal) < (sizeof(T) == 4 ? 1e-3F : 1e-5F));
  }
  CHECK(hits > 500);
}

TEMPLATE_TEST_CASE("implicit surface: a torus is met where small steps find it, from outside and inside",
                   "[geometry][implicit_surface]", float, double) {
  using T = TestType;
  const ImplicitSurface torus{cube<T>(1.5), Torus{}};
  int hits = 0;
  int differ = 0;
  for (const Ray<T>& ray : glint::testing::rays_into(bounds(torus), 600, 9)) {
    const Ray<double> exact{Vec3<double>(ray.origin), Vec3<double>(ray.direction)};
    const double t_max = 12 / glm::length(exact.direction);
    const auto expected =
        glint::testing::first_sign_change(exact, t_max, [](const Vec3<double>& p) { return Torus{}(p); });
    const auto hit = intersect(ray, torus);
    if (hit.has_value() != expected.has_value()) {
      ++differ;  // it grazes
      continue;
    }
    if (!hit) continue;
    ++hits;
    REQUIRE(std::abs(Torus{}(exact.at(double(hit->t)))) < 1e-5);
    if (std::abs(double(hit->t) - *expected) * glm::length(exact.direction) > 1e-2) ++differ;
  }
  CHECK(hits > 100);
  CHECK(differ <= hits / 50);
}

TEMPLATE_TEST_CASE("implicit surface: rays that leave it outward never meet it again where it bends away",
                   "[geometry][implicit_surface]", float, double) {
  using T = TestType;
  const ImplicitSurface ball{cube<T>(1.25), Ball{}};
  glint::Random random(3);
  int wrong = 0;
  int left = 0;
  for (const Ray<T>& ray : glint::testing::rays_into(bounds(ball), 2000, 11)) {
    const auto hit = intersect(ray, ball);
    if (!hit) continue;
    const auto at = surface(ball, ray.at(hit->t));
    Vec3<T> direction = random.uniform_vec3<T>() * T(2) - T(1);
    if (glm::dot(direction, at.normal) < T(0)) direction = -direction;
    wrong += int(intersect(spawn_ray(at, direction), ball).has_value());
    wrong += int(!intersect(spawn_ray(at, -direction), ball).has_value());
    ++left;
  }
  CHECK(left > 500);
  CHECK(wrong <= left / 200);  // a ray that leaves inward at less than a detail's depth
}

TEST_CASE("implicit surface: what the box cuts off is not there", "[geometry][implicit_surface]") {
  const ImplicitSurface half{Aabb<float>{{-1.5F, -1.5F, 0}, {1.5F, 1.5F, 1.5F}}, Ball{}};
  const auto from_below = intersect(Ray<float>{{0, 0, -5}, {0, 0, 1}}, half);
  REQUIRE(from_below);
  CHECK(from_below->t == Approx(6));
  const auto from_above = intersect(Ray<float>{{0, 0, 5}, {0, 0, -1}}, half);
  REQUIRE(from_above);
  CHECK(from_above->t == Approx(4));
}

TEST_CASE("implicit surface: a tree of them, each in a cell of its own, is one surface",
          "[geometry][implicit_surface]") {
  std::vector<ImplicitSurface<float, Hills>> cells;
  for (int x = 0; x < 8; ++x) {
    for (int z = 0; z < 8; ++z) {
      const Vec3<float> lower{float(x) * 0.5F - 2, -0.25F, float(z) * 0.5F - 2};
      cells.push_back({{lower, lower + Vec3<float>{0.5F, 0.5F, 0.5F}}, Hills{}, 1.4F, 64});
    }
  }
  const glint::Bvh bvh{glint::Elements{cells}};
  const ImplicitSurface whole{Aabb<float>{{-2, -0.25F, -2}, {2, 0.25F, 2}}, Hills{}, 1.4F, 4096};
  int hits = 0;
  int differ = 0;
  for (const Ray<float>& ray : glint::testing::rays_into(bounds(whole), 1000, 13)) {
    const auto a = bvh.closest(ray);
    const auto b = intersect(ray, whole);
    hits += int(a.has_value());
    differ += int(a.has_value() != b.has_value() || (a && std::abs(a->t - b->t) > 1e-4F * (1 + a->t)));
  }
  CHECK(hits > 300);
  CHECK(differ <= 5);  // rays that graze a hill
}

}  // namespace test_geometry_implicit_surface

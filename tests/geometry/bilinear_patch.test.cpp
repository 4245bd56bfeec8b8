// SPDX-License-Identifier: MIT
#include <glint/geometry/bilinear_patch.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/geometry/concepts.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/bounds_laws.hpp>
#include <glint/testing/primitive_laws.hpp>

namespace test_geometry_bilinear_patch {

static_assert(glint::ShadablePrimitive<glint::BilinearPatch<float>> &&
              glint::ShadablePrimitive<glint::BilinearPatch<double>>);

namespace {

using Vec3d = glint::Vec3<double>;

template <typename T>
std::vector<glint::BilinearPatch<T>> curved_patches() {
  return {{.p00 = {0, 0, 0}, .p10 = {1, 0, 1}, .p01 = {0, 1, 1}, .p11 = {1, 1, 0}},
          {.p00 = {-30, 10, 2}, .p10 = {-27, 9, 1}, .p01 = {-31, 12, 5}, .p11 = {-29, 15, 1}},
          {.p00 = {0, 0, 0}, .p10 = {1, 0, T(0.01)}, .p01 = {0, 1, 0}, .p11 = {1, 1, 0}}};
}

template <typename T>
Vec3d point(const glint::BilinearPatch<T>& p, double u, double v) {
  return Vec3d(p.p00) * ((1 - u) * (1 - v)) + Vec3d(p.p10) * (u * (1 - v)) + Vec3d(p.p01) * ((1 - u) * v) +
         Vec3d(p.p11) * (u * v);
}

/// The oracle: the first of 2 · 64² triangles that a ray meets, in double precision.
template <typename T>
double first_triangle(const glint::BilinearPatch<T>& patch, const glint::Ray<double>& ray) {
  constexpr int n = 64;
  double nearest = glint::infinity<double>;
  const auto corner = [&](int i, int j) { return point(patch, double(i) / n, double(j) / n); };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3d c[4] = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
      for (const auto& triangle :
           {glint::Triangle<double>{c[0], c[1], c[2]}, glint::Triangle<double>{c[0], c[2], c[3]}}) {
        const auto hit = intersect(ray, triangle);
        if (hit) nearest = std::min(nearest, hit->t);
      }
    }
  }
  return nearest;
}

}  // namespace

TEMPLATE_TEST_CASE("bilinear patch: a ray down the middle of a saddle meets the mean of the corners",
                   "[geometry][bilinear_patch]", float, double) {
  using T = TestType;
  const glint::BilinearPatch<T> saddle{.p00 = {0, 0, 0}, .p10 = {1, 0, 1}, .p01 = {0, 1, 1}, .p11 = {1, 1, 0}};
  const auto hit = intersect(glint::Ray<T>{.origin = {T(0.5), T(0.5), 3}, .direction = {0, 0, -2}}, saddle);
  REQUIRE(hit);
  CHECK(*hit == glint::Hit<T>{.t = T(1.25), .uv = {T(0.5), T(0.5)}});
  const auto at = surface(saddle, glint::Vec3<T>(), *hit);
  CHECK(at.position == glint::Vec3<T>(T(0.5), T(0.5), T(0.5)));
  CHECK(at.normal == glint::Vec3<T>(0, 0, 1));  // both derivatives are level there
}

TEMPLATE_TEST_CASE("bilinear patch: a ray along a saddle's ridge meets it twice", "[geometry][bilinear_patch]", float,
                   double) {
  using T = TestType;
  // z = u + v − 2 u v; on the diagonal u = v = s it is 2 s − 2 s², which is 3/8 where s = 1/4 and 3/4
  const glint::BilinearPatch<T> saddle{.p00 = {0, 0, 0}, .p10 = {1, 0, 1}, .p01 = {0, 1, 1}, .p11 = {1, 1, 0}};
  glint::Ray<T> ray{.origin = {-1, -1, T(0.375)}, .direction = {1, 1, 0}};
  const auto first = intersect(ray, saddle);
  REQUIRE(first);
  CHECK(first->t == Approx(1.25));
  ray.t_min = T(1.5);
  const auto second = intersect(ray, saddle);
  REQUIRE(second);
  CHECK(second->t == Approx(1.75));
  ray.t_min = 2;
  CHECK_FALSE(intersect(ray, saddle));
}

TEMPLATE_TEST_CASE("bilinear patch: agrees with a fine mesh of triangles", "[geometry][bilinear_patch]", float,
                   double) {
  using T = TestType;
  for (const auto& patch : curved_patches<T>()) {
    const double size = double(glm::length(extent(bounds(patch))));
    int hits = 0;
    int differences = 0;
    for (const auto& ray : glint::testing::rays_into(bounds(patch), 300, 3)) {
      const double expected = first_triangle(patch, {Vec3d(ray.origin), Vec3d(ray.direction)});
      const auto hit = intersect(ray, patch);
      if (hit) {
        const Vec3d on_ray = Vec3d(ray.origin) + Vec3d(ray.direction) * double(hit->t);
        const double off = glm::length(on_ray - point(patch, double(hit->uv.x), double(hit->uv.y)));
        REQUIRE(off <= 300 * double(std::numeric_limits<T>::epsilon()) * (size + glm::length(on_ray)));
      }
      if (hit.has_value() != (expected < glint::infinity<double>)) {
        ++differences;  // near the edge, or where the ray grazes: the mesh is off by size / 64² / 8
        continue;
      }
      if (!hit) continue;
      ++hits;
      if (std::abs(double(hit->t) - expected) * glm::length(Vec3d(ray.direction)) > 2e-3 * size) ++differences;
    }
    CHECK(hits > 30);
    CHECK(differences <= 4);
  }
}

TEMPLATE_TEST_CASE("bilinear patch: a flat one is the quad", "[geometry][bilinear_patch]", float, double) {
  using T = TestType;
  const glint::Quad<T> quad{.origin = {1, 2, 3}, .edge_u = {1, T(0.3), 0}, .edge_v = {T(0.2), 1, T(0.7)}};
  const glint::BilinearPatch<T> patch{quad.origin, quad.origin + quad.edge_u, quad.origin + quad.edge_v,
                                      quad.origin + quad.edge_u + quad.edge_v};
  int hits = 0;
  for (const auto& ray : glint::testing::rays_into(bounds(quad), 4000, 4)) {
    const auto hit = intersect(ray, patch);
    const auto expected = intersect(ray, quad);
    const auto is_near_edge = [](T x) { return std::abs(x) < T(1e-3) || std::abs(x - T(1)) < T(1e-3); };
    if (hit.has_value() != expected.has_value()) {
      const auto uv = hit ? hit->uv : expected->uv;
      REQUIRE((is_near_edge(uv.x) || is_near_edge(uv.y)));
      continue;
    }
    if (!hit) continue;
    ++hits;
    const T facing = std::abs(glm::dot(glm::normalize(ray.direction), surface(quad, {}, *expected).normal));
    const T rounding = 200 * std::numeric_limits<T>::epsilon() / facing;
    REQUIRE(std::abs(hit->t - expected->t) <= rounding * std::max(T(1), expected->t));
    REQUIRE(std::abs(hit->uv.x - expected->uv.x) <= rounding);
    REQUIRE(std::abs(hit->uv.y - expected->uv.y) <= rounding);
  }
  CHECK(hits > 1000);
}

TEMPLATE_TEST_CASE("bilinear patch: equal corners make a triangle, with normals up to the corner",
                   "[geometry][bilinear_patch]", float, double) {
  using T = TestType;
  const glint::BilinearPatch<T> patch{.p00 = {0, 0, 0}, .p10 = {1, 0, 0}, .p01 = {0, 1, 0}, .p11 = {0, 1, 0}};
  const glint::Triangle<T> triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  int hits = 0;
  glint::Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const glint::Ray<T> ray{.origin = random.template uniform_vec3<T>() + glint::Vec3<T>(0, 0, 1),
                            .direction = {T(0.1), T(-0.2), -1}};
    const auto hit = intersect(ray, patch);
    const auto expected = intersect(ray, triangle);
    REQUIRE(hit.has_value() == expected.has_value());
    if (!hit) continue;
    ++hits;
    CHECK(hit->t == Approx(expected->t));
  }
  CHECK(hits > 500);
  const auto tip = surface(patch, {}, glint::Hit<T>{.uv = {T(0.5), 1}});
  CHECK(tip.normal == glint::Vec3<T>(0, 0, 1));
}

TEMPLATE_TEST_CASE("bilinear patch: is not hit along its plane, without area, or with a NaN",
                   "[geometry][bilinear_patch]", float, double) {
  using T = TestType;
  using Patch = glint::BilinearPatch<T>;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  CHECK_FALSE(intersect(glint::Ray<T>{.origin = {-1, T(0.5), 0}, .direction = {1, 0, 0}}, Patch{}));
  const glint::Ray<T> ray{.origin = {T(0.5), T(0.5), 1}};
  REQUIRE(intersect(ray, Patch{}));
  CHECK_FALSE(intersect(ray, Patch{.p00 = {nan, 0, 0}}));
  CHECK_FALSE(intersect(ray, Patch{.p11 = {1, nan, 0}}));
  const glint::Vec3<T> spot{T(0.5), T(0.5), 0};
  CHECK_FALSE(intersect(ray, Patch{spot, spot, spot, spot}));
  CHECK_FALSE(intersect(ray, Patch{{0, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}}));
}

TEMPLATE_TEST_CASE("bilinear patch: rays that leave it to the hollow side's outside do not meet where they left",
                   "[geometry][bilinear_patch]", float, double) {
  using T = TestType;
  glint::Random random(8);
  for (const auto& patch : curved_patches<T>()) {
    for (int i = 0; i < 3000; ++i) {
      const auto uv = random.template uniform_vec2<T>();
      const auto at = surface(patch, {}, glint::Hit<T>{.uv = uv});
      const T size = glm::length(extent(bounds(patch)));
      for (const T side : {T(1), T(-1)}) {
        const auto ray = spawn_ray(at, at.normal * side);
        const auto hit = intersect(ray, patch);  // along the normal the patch may be met again, but not nearby
        REQUIRE((!hit || hit->t > size * T(0.01)));
      }
    }
  }
}

TEMPLATE_TEST_CASE("bilinear patch: obeys the laws of Primitive, in tight bounds", "[geometry][bilinear_patch][laws]",
                   float, double) {
  const auto seed = GENERATE(range(0U, 12U));
  CAPTURE(seed);
  for (const auto& patch : curved_patches<TestType>()) {
    CHECK(glint::testing::violations_of_primitive_laws(patch, seed) == std::vector<std::string>{});
  }
  CHECK(glint::testing::violations_of_primitive_laws(glint::BilinearPatch<TestType>{}, seed).empty());
  const auto saddle = curved_patches<TestType>()[0];
  CHECK(glint::testing::violations_of_tight_bounds(saddle, seed, TestType(0.1)) == std::vector<std::string>{});
}

}  // namespace test_geometry_bilinear_patch

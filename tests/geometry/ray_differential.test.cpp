// SPDX-License-Identifier: MIT
#include <glint/geometry/ray_differential.hpp>  // first, so the header proves it stands alone

#include <cmath>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_geometry_ray_differential {

namespace {

using glint::Ray;
using glint::RayDifferential;
using glint::Surface;
using glint::Vec3;

/// Where a ray meets the plane, in double.
Vec3<double> on_plane(const Ray<float>& ray, const Surface& plane) {
  const Vec3<double> origin(ray.origin);
  const Vec3<double> direction(ray.direction);
  const Vec3<double> normal(plane.normal);
  return origin + direction * (glm::dot(normal, Vec3<double>(plane.position) - origin) / glm::dot(normal, direction));
}

}  // namespace

TEST_CASE("ray differential: on a surface, it is where the neighboring rays meet the tangent plane",
          "[geometry][ray_differential]") {
  glint::Random random(1);
  const auto small_step = [&] { return (random.uniform_vec3<float>() - 0.5F) * 2e-3F; };
  for (int i = 0; i < 200; ++i) {
    const Ray<float> ray{.origin = random.uniform_vec3<float>(),
                         .direction = glint::normalized(random.uniform_vec3<float>() - Vec3<float>(0.5F))};
    Surface at{.position = ray.at(1 + random.uniform<float>())};
    at.normal = glint::normalized(random.uniform_vec3<float>() - Vec3<float>(0.5F));
    if (std::abs(glm::dot(at.normal, ray.direction)) < 0.2F) continue;
    const RayDifferential differential{small_step(), small_step(), small_step(), small_step()};
    const glint::Footprint footprint = footprint_at(at, ray, differential);
    const Ray<float> across{ray.origin + differential.origin_x, ray.direction + differential.direction_x};
    const Ray<float> upward{ray.origin + differential.origin_y, ray.direction + differential.direction_y};
    // To first order: what is left is the square of steps of about 10⁻³ times distance over cosine, and roundings.
    CHECK(glm::distance(Vec3<double>(footprint.x), on_plane(across, at) - on_plane(ray, at)) < 3e-4);
    CHECK(glm::distance(Vec3<double>(footprint.y), on_plane(upward, at) - on_plane(ray, at)) < 3e-4);
    CHECK(std::abs(glm::dot(footprint.x, at.normal)) < 1e-6F);
  }
}

TEST_CASE("ray differential: grows with the distance, and lengthens at a slant", "[geometry][ray_differential]") {
  const RayDifferential pinhole{.direction_x = {0.01F, 0, 0}, .direction_y = {0, 0.01F, 0}};
  const Ray<float> down{.direction = {0, 0, -1}};
  CHECK(footprint_at({.position = {0, 0, -5}}, down, pinhole) ==
        glint::Footprint{{5 * 0.01F, 0, 0}, {0, 5 * 0.01F, 0}});
  // A plane that rises with y at 60°, so that its normal is that far from the ray: twice as long, along the slope.
  const float sine = std::sqrt(0.75F);
  const auto slanted = footprint_at({.position = {0, 0, -5}, .normal = {0, -sine, 0.5F}}, down, pinhole);
  CHECK(glm::length(slanted.x) == Approx(0.05));
  CHECK(glm::length(slanted.y) == Approx(0.1));
}

TEST_CASE("ray differential: stays finite where a ray runs along the surface", "[geometry][ray_differential]") {
  const RayDifferential pinhole{.direction_x = {0, 0, 0.01F}, .direction_y = {0, 0.01F, 0}};
  const auto footprint = footprint_at({.position = {2, 0, 0}}, {.direction = {1, 0, 0}}, pinhole);
  CHECK(glint::is_finite(footprint.x));
  CHECK(footprint.y == glint::Vec3<float>{0, 0.02F, 0});
}

}  // namespace test_geometry_ray_differential

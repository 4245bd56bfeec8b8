// SPDX-License-Identifier: MIT
#include <glint/scene/path_footprint.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstdint>
#include <type_traits>
#include <vector>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/bsdf/lambertian.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/textured.hpp>
#include <glint/scene/counted.hpp>
#include <glint/scene/scene.hpp>
#include <glint/texture/any_texture.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/filtered_image_texture.hpp>

namespace test_scene_path_footprint {

namespace {

using glint::Interaction;
using glint::Lambertian;
using glint::Lobe;
using glint::PathFootprint;
using glint::Ray;
using glint::RayDifferential;
using glint::Vec3;

using Walls = glint::Bvh<glint::Elements<glint::Quad<float>>>;
using Plain = glint::OneOf<Lambertian, glint::Textured<Lambertian, glint::Checkerboard>>;
using Filtered =
    glint::OneOf<Lambertian,
                 glint::Textured<Lambertian, glint::OneOf<glint::ConstantTexture, glint::FilteredImageTexture>>>;

/// One that is no template says so itself.
struct OwnMaterial {
  static constexpr bool asks_for_footprints = true;
  static Lambertian bsdf(const glint::Surface& at) { return {{glm::length(at.footprint.x)}}; }
};

static_assert(!glint::FilteringScene<glint::Scene<Walls>>);
static_assert(!glint::FilteringScene<glint::Scene<Walls, glint::MaterialTable<Plain>>>);
static_assert(glint::FilteringScene<glint::Scene<Walls, glint::MaterialTable<Filtered>>>);
static_assert(glint::FilteringScene<glint::Scene<Walls, glint::Textured<Lambertian, glint::AnyTexture>>>);
static_assert(glint::FilteringScene<glint::Scene<Walls, OwnMaterial>>);
static_assert(glint::FilteringScene<glint::Counted<glint::Scene<Walls, OwnMaterial>>>);
static_assert(!glint::FilteringScene<glint::Counted<glint::Scene<Walls>>>);
static_assert(std::is_empty_v<glint::NoFootprint>);

constexpr RayDifferential pinhole{.direction_x = {0.01F, 0, 0}, .direction_y = {0, 0.01F, 0}};

/// A point of a surface that a ray has met, with the footprint that it brought.
Interaction<Lambertian> met(const Ray<float>& ray, float t, const Vec3<float>& normal, const PathFootprint& path) {
  Interaction<Lambertian> at;
  at.surface.position = ray.at(t);
  at.surface.normal = normal;
  at.surface.footprint = footprint_at(at.surface, ray, path.differential());
  at.wo = -ray.direction;
  return at;
}

}  // namespace

TEST_CASE("path footprint: seen in a flat mirror, it is that of the mirrored camera", "[scene][path_footprint]") {
  // The camera looks down at a mirror through the origin, tilted by 20°, which shows a wall. Unfolded, the ray goes on
  // straight, to the mirrored wall: the footprint there is the mirrored footprint on the wall.
  const float tilt = 0.35F;
  const Vec3<float> normal{std::sin(tilt), 0, std::cos(tilt)};
  const auto mirrored = [&](const Vec3<float>& v) { return v - normal * (2 * glm::dot(normal, v)); };
  const Ray<float> ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
  PathFootprint path(pinhole);
  const auto at = met(ray, 3, normal, path);
  const Vec3<float> onward = mirrored(ray.direction);
  path.scatter(at, {.pdf = 1, .lobe = Lobe::Specular}, onward);

  glint::Surface wall{.position = onward * 2.0F, .normal = glint::normalized(Vec3<float>{-1, 0.3F, -0.2F})};
  const auto found = footprint_at(wall, Ray<float>{.direction = onward}, path.differential());
  glint::Surface unfolded{.position = mirrored(wall.position), .normal = mirrored(wall.normal)};
  const auto expected = footprint_at(unfolded, ray, pinhole);
  CHECK(glm::distance(found.x, mirrored(expected.x)) < 1e-5F);
  CHECK(glm::distance(found.y, mirrored(expected.y)) < 1e-5F);
  CHECK(glm::length(expected.y) > 0.05F);  // 5 away, by 0.01: these are no zeros
}

TEST_CASE("path footprint: through thin glass it goes on as it came", "[scene][path_footprint]") {
  const Ray<float> ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
  PathFootprint path(pinhole);
  const auto at = met(ray, 3, {0, 0, 1}, path);
  path.scatter(at, {.wi = {0, 0, -1}, .pdf = 1, .lobe = Lobe::Specular}, ray.direction);
  const auto found = footprint_at({.position = {0, 0, -4}}, {.direction = {0, 0, -1}}, path.differential());
  CHECK(found.x.x == Approx(7 * 0.01));
  CHECK(found.y.y == Approx(7 * 0.01));
}

TEST_CASE("path footprint: a rough bounce widens it by the solid angle that the sample stands for",
          "[scene][path_footprint]") {
  const Ray<float> ray{.origin = {0, 0, 1}, .direction = {0, 0, -1}};
  const Vec3<float> up{0, 0, 1};
  const auto spread = [&](float pdf) {
    PathFootprint path(pinhole);
    path.scatter(met(ray, 1, up, path), {.pdf = pdf, .lobe = Lobe::Glossy}, up);
    const RayDifferential& d = path.differential();
    CHECK(std::abs(glm::dot(d.direction_x, d.direction_y)) < 1e-6F);
    CHECK(glm::dot(d.direction_x, up) == Approx(0).margin(1e-6));
    return double(glm::length(glm::cross(d.direction_x, d.direction_y)));
  };
  CHECK(spread(1e9F) == Approx(1e-4));            // nearly a mirror: as before, 0.01²
  CHECK(spread(625) == Approx(2e-4));             // 1 / (16 · 625) = 10⁻⁴ more
  CHECK(spread(0.5F) == Approx(1e-4 + 1.0 / 8));  // broad
  CHECK(spread(1e-9F) == Approx(1));              // but no wider than a steradian
}

TEST_CASE("path footprint: a path without one stays without", "[scene][path_footprint]") {
  PathFootprint path;
  const Ray<float> ray{.origin = {0, 0, 3}, .direction = {0, 0, -1}};
  path.scatter(met(ray, 3, {0, 0, 1}, path), {.pdf = 0.1F, .lobe = Lobe::Diffuse}, {0, 0, 1});
  CHECK(path.is_thin());
  CHECK(path.differential() == RayDifferential{});
}

TEST_CASE("path footprint: scenes put it on the surface where their materials ask", "[scene][path_footprint]") {
  const std::vector<glint::Quad<float>> quads{{.origin = {-1, -1, 0}, .edge_u = {2, 0, 0}, .edge_v = {0, 2, 0}}};
  const Walls wall{glint::Elements{quads}};
  const glint::Scene asking{wall, OwnMaterial{}};
  const Ray<float> ray{.origin = {0.25F, 0.25F, 5}, .direction = {0, 0, -1}};
  const PathFootprint path(pinhole);
  const auto at = interact(asking, ray, path);
  REQUIRE(at);
  CHECK(at->surface.footprint.x == Vec3<float>{5 * 0.01F, 0, 0});
  CHECK(at->bsdf.reflectance.g == Approx(0.05));  // it is there before the material is asked
  std::uint64_t rays = 0;
  CHECK(interact(glint::Counted{asking, rays}, ray, path)->surface == at->surface);
  CHECK(rays == 1);
  CHECK(interact(asking, ray, PathFootprint())->surface.footprint == glint::Footprint{});
  CHECK(interact(asking, ray, glint::NoFootprint{})->surface.footprint == glint::Footprint{});
  CHECK(interact(glint::Scene{wall}, ray, path)->surface.footprint == glint::Footprint{});
}

}  // namespace test_scene_path_footprint

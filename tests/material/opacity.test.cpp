// SPDX-License-Identifier: MIT
#include <glint/material/opacity.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <integrator/transport_rooms.hpp>
#include <support/catch.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/light_tracer.hpp>
#include <glint/integrator/path.hpp>
#include <glint/material/material_table.hpp>
#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>

namespace test_material_opacity {

using glint::Checkerboard;
using glint::ConstantTexture;
using glint::LightStrategy;
using glint::Path;
using glint::Ray;
using glint::Rgb;

namespace {

using Quads = std::vector<glint::Quad<float>>;

constexpr std::uint32_t opaque = glint::none<std::uint32_t>;

/// Rectangles, the last of which shines down, some covered by the opacity of a checkerboard.
struct Gauze {
  Quads quads;
  std::vector<std::uint32_t> of_primitive;
  std::vector<Checkerboard> textures;
  std::vector<std::uint32_t> materials;  ///< black, gray
  Rgb radiance{1};

  [[nodiscard]] auto geometry() const {
    // <region: opacity>
    const glint::Elements set{quads};
    const glint::Opacity opacity{set, std::span(textures), std::span(of_primitive)};
    return glint::Bvh{glint::Filtered{set, opacity}};
    // </region: opacity>
  }
  [[nodiscard]] auto scene() const {
    glint::Lights<glint::AreaLight<glint::Quad<float>>> lights{{{quads.back(), radiance}},
                                                               std::vector(quads.size(), opaque)};
    lights.of_primitive.back() = 0;
    const glint::MaterialTable<glint::Lambertian> table{{{Rgb{0}}, {Rgb{0.5F}}}, materials};
    return glint::Scene{geometry(), table, lights};
  }
};

/// The share of rays, side by side, that a ball of some opacity stops.
double stopped_by_ball(float opacity, glint::Vec3<float> origin) {
  const std::vector<glint::Sphere<float>> balls(1);
  const std::vector<ConstantTexture> textures{{Rgb{opacity}}};
  const std::vector<std::uint32_t> of_primitive{0};
  const glint::Elements set{balls};
  const glint::Bvh bvh{glint::Filtered{set, glint::Opacity{set, std::span(textures), std::span(of_primitive)}}};
  glint::Random random(7);
  int stopped = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto at = 0.5F * glint::concentric_disk(random.uniform_vec2());
    const Ray<float> ray{.origin = origin + glint::Vec3<float>{at.x, at.y, 0}};
    stopped += bvh.occluded(ray) ? 1 : 0;
  }
  return stopped / 20'000.0;
}

/// Mean and error against what is expected, in standard errors.
template <typename I, typename S, typename C>
double z_of_mean(const I& integrator, const S& scene, const C& camera, int samples, double expected) {
  const auto whole = block_means(integrator, scene, camera, samples, 16, 50).blocks.at(4);
  return std::abs(whole.mean - expected) / whole.error;
}

}  // namespace

TEST_CASE("opacity: each side of a surface stops its share of light, on its own", "[material][opacity]") {
  CHECK(stopped_by_ball(1, {0, 0, 3}) == 1);
  CHECK(stopped_by_ball(0, {0, 0, 3}) == 0);
  // From inside there is one side, from outside there are two; the deviation of 20000 rays is below 0.0036.
  CHECK(stopped_by_ball(0.4F, {0, 0, 0}) == Approx(0.4).margin(0.018));
  CHECK(stopped_by_ball(0.4F, {0, 0, 3}) == Approx(1 - 0.6 * 0.6).margin(0.018));
}

TEST_CASE("opacity: a tree stops the rays that brute force stops, at the same place", "[material][opacity]") {
  Gauze gauze;
  for (int i = 0; i < 12; ++i) {
    gauze.quads.push_back({{-1, -1, -0.2F * float(i)}, {2, 0, 0}, {0, 2, 0.1F * float(i % 3)}});
    gauze.of_primitive.push_back(i % 4 == 3 ? opaque : 0);
  }
  gauze.textures = {{.color0 = Rgb{0.1F}, .color1 = Rgb{0.5F}}};
  const auto tree = gauze.geometry();
  const glint::BruteForce brute{tree.set()};
  glint::Random random(3);
  int behind = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto uv = random.uniform_vec2();
    const Ray<float> ray{.origin = {uv.x - 0.5F, uv.y - 0.5F, 2}, .direction = {0.1F, 0.2F * uv.x, -1}};
    const auto hit = tree.closest(ray);
    const auto expected = brute.closest(ray);
    REQUIRE(hit.has_value() == expected.has_value());
    REQUIRE(hit->primitive == expected->primitive);
    CHECK(tree.occluded(ray));
    behind += hit->primitive != 0 ? 1 : 0;
  }
  CHECK(behind > 1000);
}

TEST_CASE("opacity: below a lamp behind gauze the floor gets what the gauze lets pass", "[material][opacity]") {
  const FloorBelowLamp floor;
  Gauze gauze{.quads = floor.quads,
              .of_primitive = {opaque, 0, opaque},
              .textures = {{.color0 = Rgb{0.4F}, .color1 = Rgb{0.4F}}},
              .materials = {1, 0, 0}};
  gauze.quads.insert(gauze.quads.begin() + 1, {{-4, 1.5F, -4}, {8, 0, 0}, {0, 0, 8}});  // black, above the camera
  const auto scene = gauze.scene();
  const double expected = 0.6 * floor_below_lamp(0.5, 0.5);
  // Of five means each exceeds five standard errors, with Student's t of 15 degrees, with a chance below 2e-4.
  for (const auto strategy : {LightStrategy::Mis, LightStrategy::NextEvent, LightStrategy::RandomWalk}) {
    CHECK(z_of_mean(Path{.max_depth = 2, .strategy = strategy}, scene, floor.camera, 64, expected) < 5);
  }
  CHECK(z_of_mean(glint::Bdpt{.max_depth = 2}, scene, floor.camera, 64, expected) < 5);
}

TEST_CASE("opacity: integrators agree in a room with leaves that let some light pass", "[material][opacity]") {
  Gauze room{.quads = lamp_room(),
             .of_primitive = std::vector(9, opaque),
             .textures = {{.color0 = Rgb{0.9F}, .color1 = Rgb{0.2F}, .mapping = {.scale = {3, 3}}}},
             .materials = std::vector<std::uint32_t>(9, 1),
             .radiance = Rgb{10}};
  room.quads.insert(room.quads.begin(), {{-0.8F, 0.3F, -0.8F}, {1.6F, 0, 0}, {0, 0.2F, 1.6F}});
  room.quads.insert(room.quads.begin(), {{-0.9F, -0.9F, -0.4F}, {1.5F, 0, 0}, {0, 1.5F, 0}});
  room.of_primitive[0] = room.of_primitive[1] = 0;
  room.materials.back() = 0;
  const auto scene = room.scene();
  const glint::Perspective view{.eye = {0, 0, 0.9F}, .target = {0, -0.2F, -1}, .fov_y_radians = 1.2F};
  const auto means = [&](const auto& integrator, int samples, std::uint64_t seed) {
    return block_means(integrator, scene, view, samples, 16, seed);
  };
  // Each takes the largest of five z of means over 16 runs each: five come by chance to less than 5 · 2e-4.
  const auto walk = means(Path{.max_depth = 4, .strategy = LightStrategy::RandomWalk}, 100, 1);
  CHECK(walk.blocks.at(4).mean > 0.02);
  CHECK(largest_z(walk, means(Path{.max_depth = 4}, 30, 101)) < 5);
  CHECK(largest_z(walk, means(Path{.max_depth = 4, .strategy = LightStrategy::NextEvent}, 30, 201)) < 5);
  CHECK(largest_z(walk, means(glint::LightTracer{.max_depth = 4}, 40, 301)) < 5);
  CHECK(largest_z(walk, means(glint::Bdpt{.max_depth = 4}, 20, 401)) < 5);
}

}  // namespace test_material_opacity

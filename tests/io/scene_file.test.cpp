// SPDX-License-Identifier: MIT
#include <glint/io/scene_file.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <support/catch.hpp>

namespace test_io_scene_file {

namespace {

using glint::BuilderKind;
using glint::Ray;
using glint::Rgb;
using glint::SceneFile;
using glint::Vec3;

/// A triangle at z = 0, a sphere at z = −5, a disk at z = −10, a rectangle at z = −15, one unit around x = 0, 10,
/// 20, 30.
SceneFile one_of_each() {
  SceneFile file;
  file.mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  file.mesh.indices = {0, 1, 2};
  file.spheres = {{{10, 0, -5}, 1}};
  file.disks = {{{20, 0, -10}, {0, 0, 1}, 1}};
  file.quads = {{{29, -1, -15}, {2, 0, 0}, {0, 2, 0}}};
  const auto diffuse = [](float albedo) {
    return glint::SceneMaterial(glint::SceneDiffuse{.texture = glint::ConstantTexture{albedo}});
  };
  file.materials = {diffuse(0.1F), diffuse(0.2F), diffuse(0.3F), diffuse(0.4F)};
  const auto no_light = glint::none<std::uint32_t>;
  file.attributes = {{{{0}, {no_light}}, {{1}, {no_light}}, {{2}, {0}}, {{3}, {no_light}}}};
  file.lights = {glint::AreaLight<glint::Disk<float>>{file.disks[0], 7}};
  return file;
}

}  // namespace

TEST_CASE("scene file: primitives are numbered as triangles, spheres, disks, rectangles", "[io][scene]") {
  const SceneFile file = one_of_each();
  CHECK(file.triangle_count() == 1);
  CHECK(file.shapes().size() == 4);
  for (const BuilderKind builder : {BuilderKind::Median, BuilderKind::Morton, BuilderKind::BinnedSah,
                                    BuilderKind::SweepSah, BuilderKind::SpatialSah, BuilderKind::Best}) {
    SceneFile copy = file;
    copy.accelerator.builder = builder;
    const auto bvh = bvh_of(copy);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const auto hit = bvh.closest(Ray<float>{.origin = {10.0F * static_cast<float>(i), 0, 9}});
      REQUIRE(hit);
      CHECK(hit->primitive == i);
    }
  }
}

TEST_CASE("scene file: each primitive of the scene has its material and its light", "[io][scene]") {
  const SceneFile file = one_of_each();
  const auto scene = scene_of(file);
  CHECK(scene.light_count() == 1);
  for (std::uint32_t i = 0; i < 4; ++i) {
    const auto at = scene.interact(Ray<float>{.origin = {10.0F * static_cast<float>(i), 0, 9}});
    REQUIRE(at);
    const Vec3<float> up{0, 0, 1};
    // A diffuse surface reflects albedo / π.
    CHECK(at->bsdf.evaluate(up, up).r == Approx(0.1 * (static_cast<double>(i) + 1) / 3.14159265));
    CHECK(at->light == (i == 2 ? 0 : glint::none<std::uint32_t>));
  }
}

TEST_CASE("scene file: one without anything is a scene that no ray meets", "[io][scene]") {
  const SceneFile file;
  const auto scene = scene_of(file);
  CHECK_FALSE(scene.interact(Ray<float>{}));
  CHECK_FALSE(scene.occluded(Ray<float>{}));
  CHECK(scene.background({0, 1, 0}) == Rgb{0});
}

TEST_CASE("scene file: a scene is of the type that lets light pass only where something does", "[io][scene]") {
  SceneFile file = one_of_each();
  CHECK(any_scene_of(file).get_if<glint::LoadedScene>() != nullptr);
  file.opacities = {glint::ConstantTexture{Rgb{0}}};
  file.opacity_of_primitive.assign(4, glint::none<std::uint32_t>);
  file.opacity_of_primitive[1] = 0;
  const auto scene = any_scene_of(file);
  REQUIRE(scene.get_if<glint::MaskedScene>() != nullptr);
  const auto met = [&](float x) {
    return scene.visit([&](const auto& one) { return one.occluded(Ray<float>{.origin = {x, 0, 9}}); });
  };
  CHECK(met(0));
  CHECK_FALSE(met(10));  // the sphere
  CHECK(met(20));
}

}  // namespace test_io_scene_file

// SPDX-License-Identifier: MIT
#include <glint/io/scene_objects.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_scene_objects {

namespace {

using glint::JsonObject;
using glint::Rgb;
using glint::Vec3;
using glint::detail::SceneDraft;
using glint::testing::json_error;
using glint::testing::JsonText;
using glint::testing::TemporaryDirectory;

constexpr std::uint32_t no_light = glint::none<std::uint32_t>;

SceneDraft draft_with_mirror() {
  SceneDraft draft;
  draft.materials.emplace("mirror", draft.add_material(glint::Mirror{}));
  return draft;
}

glint::SceneFile scene_of_object(const std::string& text, const std::filesystem::path& folder = {}) {
  JsonText json(text);
  json.source.path = folder / "scene.json";
  SceneDraft draft = draft_with_mirror();
  glint::detail::read_object(json.object(), draft);
  CHECK(json.source.warnings.empty());
  return draft.scene;
}

std::string object_error(const std::string& text) {
  return json_error(text, [](JsonObject object) {
    SceneDraft draft = draft_with_mirror();
    glint::detail::read_object(std::move(object), draft);
    return 0;
  });
}

}  // namespace

TEST_CASE("scene objects: a sphere has its material and no light", "[io][scene]") {
  const auto scene =
      scene_of_object(R"({"type": "sphere", "center": [1, 2, 3], "radius": 4, "material_name": "mirror"})");
  REQUIRE(scene.spheres.size() == 1);
  CHECK(scene.spheres[0].center == Vec3<float>(1, 2, 3));
  CHECK(scene.spheres[0].radius == 4);
  CHECK(scene.attributes[1].materials == std::vector<std::uint32_t>{0});
  CHECK(scene.attributes[1].lights == std::vector{no_light});
  CHECK(scene.lights.empty());
  const auto unit = scene_of_object(R"({"type": "sphere", "material_name": "mirror"})");
  CHECK(unit.spheres[0].center == Vec3<float>(0));
  CHECK(unit.spheres[0].radius == 1);
}

TEST_CASE("scene objects: a lamp without a material is black; its radiance is 1 unless it says otherwise",
          "[io][scene]") {
  const auto scene = scene_of_object(R"({"type": "sphere", "light": {}})");
  REQUIRE(scene.lights.size() == 1);
  CHECK(scene.lights[0].get_if<glint::AreaLight<glint::Sphere<float>>>()->radiance == Rgb{1});
  CHECK(scene.attributes[1].lights == std::vector<std::uint32_t>{0});
  REQUIRE(scene.attributes[1].materials == std::vector<std::uint32_t>{1});
  CHECK(scene.materials[1].get_if<glint::SceneDiffuse>()->texture.evaluate(glint::Vec2<float>{0, 0}) == Rgb{0});
}

TEST_CASE("scene objects: disks and rectangles, shining and with a material", "[io][scene]") {
  const auto disk = scene_of_object(
      R"({"type": "disk", "center": [0, 1, 0], "normal": [0, -2, 0], "radius": 3, "material_name": "mirror",
          "light": {"type": "area", "radiance": [4, 5, 6]}})");
  REQUIRE(disk.disks.size() == 1);
  CHECK(disk.disks[0].radius == 3);
  CHECK(disk.attributes[2].materials == std::vector<std::uint32_t>{0});
  CHECK(disk.lights[0].get_if<glint::AreaLight<glint::Disk<float>>>()->radiance == Rgb{4, 5, 6});
  const auto quad = scene_of_object(
      R"({"type": "rectangle", "center": [0, 1, 0], "edge_u": [4, 0, 0], "edge_v": [0, 0, -2], "light": {}})");
  REQUIRE(quad.quads.size() == 1);
  CHECK(quad.quads[0].origin == Vec3<float>(-2, 1, 1));
  CHECK(quad.quads[0].edge_u == Vec3<float>(4, 0, 0));
  CHECK(area(quad.quads[0]) == 8);
  CHECK(quad.attributes[3].lights == std::vector<std::uint32_t>{0});
}

TEST_CASE("scene objects: a mesh is transformed, row by row, and then translated", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  // x' = 2x + 5, y' = −z, z' = y: then shifted by (1, 2, 3).
  const auto scene = scene_of_object(
      R"({"type": "mesh", "path": "t.obj", "material_name": "mirror",
          "transform": [2, 0, 0, 5, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1], "translate": [1, 2, 3]})",
      directory.path());
  CHECK(scene.mesh.positions == std::vector<Vec3<float>>{{6, 2, 3}, {8, 2, 3}, {6, 2, 4}});
  CHECK(scene.attributes[0].materials == std::vector<std::uint32_t>{0});
  CHECK(scene.attributes[0].lights == std::vector{no_light});
  CHECK(scene.inputs == std::vector{directory / "t.obj"});
}

TEST_CASE("scene objects: a mesh's triangles know which of the scene's lights they are", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("q.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 2 0\nf 1 2 3 4\nf 4 3 5\n");
  const auto scene =
      scene_of_object(R"({"type": "mesh", "path": "q.obj", "light": {"radiance": [1, 2, 3]}})", directory.path());
  REQUIRE(scene.lights.size() == 2);
  CHECK(scene.attributes[0].lights == std::vector<std::uint32_t>{0, 0, 1});
  CHECK(area(scene.lights[0].get_if<glint::AreaLight<glint::Quad<float>>>()->shape) == 1);
  CHECK(area(scene.lights[1].get_if<glint::AreaLight<glint::Triangle<float>>>()->shape) == 0.5F);
}

TEST_CASE("scene objects: a mesh that names no material has those of its MTL file", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("m.mtl", "newmtl red\nKd 1 0 0\n");
  directory.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
  const auto own = scene_of_object(R"({"type": "mesh", "path": "m.obj"})", directory.path());
  CHECK(own.attributes[0].materials == std::vector<std::uint32_t>{1});
  const auto named =
      scene_of_object(R"({"type": "mesh", "path": "m.obj", "material_name": "mirror"})", directory.path());
  CHECK(named.attributes[0].materials == std::vector<std::uint32_t>{0});
}

TEST_CASE("scene objects: what shines cannot let light pass", "[io][scene]") {
  JsonText json(R"({"type": "sphere", "material_name": "gauze", "light": {}})");
  SceneDraft draft;
  draft.materials.emplace("gauze", draft.add_material(glint::Mirror{}, glint::ConstantTexture{Rgb{0.5F}}));
  CHECK(glint::testing::message_of<glint::IoError>([&] { glint::detail::read_object(json.object("/x"), draft); },
                                                   "scene.json:") ==
        "/x/material_name: what shines is opaque, but the material \"gauze\" has \"opacity\"");
}

TEST_CASE("scene objects: a transform that flattens is warned of", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  JsonText json(R"({"type": "mesh", "path": "t.obj", "material_name": "mirror",
    "transform": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]})");
  json.source.path = directory / "scene.json";
  SceneDraft draft = draft_with_mirror();
  glint::detail::read_object(json.object("/objects/0"), draft);
  CHECK(json.source.warnings == std::vector{(directory / "scene.json").string() +
                                            ":/objects/0/transform: flattens the mesh: it has no inverse"});
}

TEST_CASE("scene objects: a wrong object is an error that tells what was found and expected", "[io][scene]") {
  CHECK(object_error("{}") == "/x: the key \"type\" is missing");
  CHECK(object_error(R"({"type": "instance"})") ==
        "/x/type: found \"instance\", expected one of \"mesh\", \"sphere\", \"rectangle\", \"disk\"");
  CHECK(object_error(R"({"type": "sphere"})") ==
        "/x: the keys \"material_name\" and \"light\" are both missing, expected one of them");
  CHECK(object_error(R"({"type": "sphere", "material_name": "miror"})") ==
        "/x/material_name: there is no material named \"miror\"; did you mean \"mirror\"?");
  CHECK(object_error(R"({"type": "sphere", "radius": 0, "light": {}})") ==
        "/x/radius: found 0, expected a number above 0");
  CHECK(object_error(R"({"type": "sphere", "light": {"type": "point"}})") ==
        "/x/light/type: found \"point\", expected one of \"area\"");
  CHECK(object_error(R"({"type": "sphere", "light": {"radiance": [1, 2, -3]}})") ==
        "/x/light/radiance: found [1,2,-3], expected three numbers from 0 up");
  CHECK(object_error(R"({"type": "disk", "normal": [0, 0, 0], "light": {}})") ==
        "/x/normal: found an array of 3, expected a vector that is not zero");
  CHECK(object_error(R"({"type": "rectangle", "edge_u": [1, 0, 0], "edge_v": [2, 0, 0], "light": {}})") ==
        "/x: \"edge_u\" and \"edge_v\" span no area");
  CHECK(object_error(R"({"type": "mesh", "light": {}})") == "/x: the key \"path\" is missing");
  CHECK(object_error(R"({"type": "mesh", "path": "a.ply", "light": {}})") ==
        "/x/path: a.ply: cannot be read as a mesh: expected .obj");
  CHECK(object_error(R"({"type": "mesh", "path": "a.obj", "transform": [1], "light": {}})") ==
        "/x/transform: found an array of 1, expected an array of 16 numbers");
}

TEST_CASE("scene objects: a mesh without area, or without a material, is an error", "[io][scene]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("t.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n").string();
  CHECK(object_error(R"({"type": "mesh", "path": ")" + path + R"(", "light": {}})") ==
        "/x: a mesh without area cannot be a light");
  CHECK(object_error(R"({"type": "mesh", "path": ")" + path + R"("})") ==
        "/x: the keys \"material_name\" and \"light\" are both missing, expected one of them");
}

}  // namespace test_io_scene_objects

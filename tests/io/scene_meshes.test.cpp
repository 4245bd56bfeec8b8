// SPDX-License-Identifier: MIT
#include <glint/io/scene_meshes.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_scene_meshes {

namespace {

using glint::Affine;
using glint::IoError;
using glint::JsonSource;
using glint::MeshBuffers;
using glint::Rgb;
using glint::Vec3;
using glint::detail::MtlUse;
using glint::detail::SceneDraft;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

/// In the plane z = 0, seen counterclockwise from +z.
MeshBuffers<float> triangle() {
  return {.positions = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}}, .normals = {}, .uvs = {}, .indices = {0, 1, 2}};
}

std::optional<Rgb> evenly(std::uint32_t /*triangle*/) {
  return Rgb{1};
}

Vec3<float> geometric_normal(const MeshBuffers<float>& mesh) {
  const auto& p = mesh.positions;
  const auto& i = mesh.indices;
  return glm::normalize(glm::cross(p[i[1]] - p[i[0]], p[i[2]] - p[i[0]]));
}

}  // namespace

TEST_CASE("scene meshes: a placement moves positions", "[io][scene]") {
  auto mesh = triangle();
  glint::detail::place_mesh(mesh, Affine<float>{.linear = glint::Mat3<float>(2), .translation = {1, 2, 3}});
  CHECK(mesh.positions == std::vector<Vec3<float>>{{1, 2, 3}, {5, 2, 3}, {1, 4, 3}});
}

TEST_CASE("scene meshes: normals stay perpendicular under any placement, with length 1", "[io][scene]") {
  auto mesh = triangle();
  mesh.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 0}};
  // x grows by the depth: the plane z = 0 tilts to z' = x.
  const Affine<float> shear{.linear = {1, 0, 1, 0, 1, 0, 0, 0, 1}};
  glint::detail::place_mesh(mesh, shear);
  const float root = std::sqrt(0.5F);
  CHECK(mesh.normals[0].x == Approx(-root));
  CHECK(mesh.normals[0].z == Approx(root));
  CHECK(mesh.normals[2] == Vec3<float>(0));  // none stays none
  CHECK(glm::dot(geometric_normal(mesh), mesh.normals[0]) == Approx(1));
}

TEST_CASE("scene meshes: in a mirror image the winding follows the normals where there are any", "[io][scene]") {
  const auto mirror = Affine<float>::scale({-1, 1, 1});
  auto with_normals = triangle();
  with_normals.normals.assign(3, {0, 0, 1});
  glint::detail::place_mesh(with_normals, mirror);
  CHECK(geometric_normal(with_normals) == Vec3<float>(0, 0, 1));
  CHECK(with_normals.indices == std::vector<std::uint32_t>{0, 2, 1});
  auto without = triangle();
  glint::detail::place_mesh(without, mirror);
  CHECK(geometric_normal(without) == Vec3<float>(0, 0, -1));
}

TEST_CASE("scene meshes: a flattened mesh keeps no normals of its own", "[io][scene]") {
  auto mesh = triangle();
  mesh.normals.assign(3, {0, 0, 1});
  glint::detail::place_mesh(mesh, Affine<float>::scale({1, 1, 0}));
  CHECK(mesh.normals.empty());
}

TEST_CASE("scene meshes: meshes with and without normals and uvs become one", "[io][scene]") {
  MeshBuffers<float> all;
  glint::detail::append_mesh(all, triangle());
  auto second = triangle();
  second.normals.assign(3, {0, 0, 1});
  second.uvs.assign(3, {0.5F, 0.25F});
  glint::detail::append_mesh(all, second);
  glint::detail::append_mesh(all, triangle());
  CHECK(all.positions.size() == 9);
  CHECK(all.indices == std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7, 8});
  REQUIRE(all.normals.size() == 9);
  REQUIRE(all.uvs.size() == 9);
  CHECK(all.normals[2] == Vec3<float>(0));
  CHECK(all.normals[3] == Vec3<float>(0, 0, 1));
  CHECK(all.normals[8] == Vec3<float>(0));
  CHECK(std::isnan(all.uvs[0].x));
  CHECK(all.uvs[5] == glint::Vec2<float>(0.5F, 0.25F));
  CHECK(std::isnan(all.uvs[6].x));
}

TEST_CASE("scene meshes: a triangle shines as itself; one without area does not, nor one without radiance",
          "[io][scene]") {
  auto mesh = triangle();
  mesh.positions.emplace_back(4.0F, 0.0F, 0.0F);
  mesh.indices = {0, 1, 3, 0, 1, 2, 0, 1, 2};  // the first is flat
  SceneDraft draft;
  const auto radiance_of = [](std::uint32_t i) { return i < 2 ? std::optional(Rgb{1, 2, 3}) : std::nullopt; };
  const auto lights = glint::detail::add_mesh_lights(mesh, radiance_of, draft);
  CHECK(lights == std::vector{glint::none<std::uint32_t>, 0U, glint::none<std::uint32_t>});
  REQUIRE(draft.scene.lights.size() == 1);
  const auto* light = draft.scene.lights[0].get_if<glint::AreaLight<glint::Triangle<float>>>();
  REQUIRE(light != nullptr);
  CHECK(light->shape == glint::Triangle<float>{{0, 0, 0}, {2, 0, 0}, {0, 1, 0}});
  CHECK(light->radiance == Rgb{1, 2, 3});
}

TEST_CASE("scene meshes: two triangles that are a parallelogram shine as one, wherever their corners begin",
          "[io][scene]") {
  MeshBuffers<float> mesh{
      .positions = {{0, 0, 1}, {2, 0, 1}, {3, 1, 1}, {1, 1, 1}}, .normals = {}, .uvs = {}, .indices = {}};
  const auto turn = GENERATE(range(0U, 9U));
  const std::array first{0U, 1U, 2U};
  const std::array second{0U, 2U, 3U};
  for (unsigned i = 0; i < 3; ++i) mesh.indices.push_back(first[(i + turn % 3) % 3]);
  for (unsigned i = 0; i < 3; ++i) mesh.indices.push_back(second[(i + turn / 3) % 3]);
  SceneDraft draft;
  const auto lights = glint::detail::add_mesh_lights(mesh, evenly, draft);
  CHECK(lights == std::vector{0U, 0U});
  REQUIRE(draft.scene.lights.size() == 1);
  const auto* light = draft.scene.lights[0].get_if<glint::AreaLight<glint::Quad<float>>>();
  REQUIRE(light != nullptr);
  CHECK(bounds(light->shape) == glint::Aabb<float>{{0, 0, 1}, {3, 1, 1}});
  CHECK(glm::cross(light->shape.edge_u, light->shape.edge_v) == Vec3<float>(0, 0, 2));  // 2 wide, 1 high, up like both
}

TEST_CASE("scene meshes: triangles that are no parallelogram, or wound differently, shine each alone", "[io][scene]") {
  MeshBuffers<float> mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1.5F, 0}, {0, 1, 0.5F}},
                          .normals = {},
                          .uvs = {},
                          .indices = {}};
  mesh.indices = GENERATE(std::vector<std::uint32_t>{0, 1, 2, 0, 2, 4},   // a trapezoid
                          std::vector<std::uint32_t>{0, 1, 2, 0, 2, 5},   // bent
                          std::vector<std::uint32_t>{0, 1, 2, 0, 3, 2});  // the second faces down
  SceneDraft draft;
  CHECK(glint::detail::add_mesh_lights(mesh, evenly, draft) == std::vector{0U, 1U});
  CHECK(draft.scene.lights.size() == 2);
}

TEST_CASE("scene meshes: the halves of a parallelogram that shine differently are two lights", "[io][scene]") {
  const MeshBuffers<float> mesh{.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}},
                                .normals = {},
                                .uvs = {},
                                .indices = {0, 1, 2, 0, 2, 3}};
  SceneDraft draft;
  const auto radiance_of = [](std::uint32_t i) { return std::optional(Rgb{float(i + 1)}); };
  CHECK(glint::detail::add_mesh_lights(mesh, radiance_of, draft) == std::vector{0U, 1U});
}

TEST_CASE("scene meshes: an MTL file's materials are two-sided, and v = 0 is the bottom of their maps", "[io][scene]") {
  const TemporaryDirectory directory;
  glint::Image image({1, 2});
  image(0, 0) = {1, 0, 0};
  write_exr(image, directory / "map.exr");
  directory.write("m.mtl", "newmtl plain\nKd 0.25 0.5 0.75\nnewmtl mapped\nmap_Kd map.exr\n");
  const auto path = directory.write("m.obj",
                                    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl mapped\nf 1 2 3\nusemtl plain\n"
                                    "f 1 3 2\n");
  SceneDraft draft;
  JsonSource source;
  (void)draft.black_material();
  const auto mesh = glint::detail::load_obj(path, MtlUse::Read, {}, draft, source);
  CHECK(mesh.materials == std::vector<std::uint32_t>{2, 1});
  using TwoSided = glint::TwoSidedMaterial<glint::SceneDiffuse>;
  const auto texture = [&](std::size_t i) { return draft.scene.materials[i].get_if<TwoSided>()->front.texture; };
  CHECK(texture(1).evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.25F, 0.5F, 0.75F});
  CHECK(texture(2).evaluate(glint::Vec2<float>{0.5F, 0.75F}) == Rgb{1, 0, 0});  // the top row
  CHECK(texture(2).evaluate(glint::Vec2<float>{0.5F, 0.25F}) == Rgb{0});
  CHECK(draft.scene.inputs == std::vector{directory / "map.exr"});
  CHECK(glint::detail::load_obj(path, MtlUse::Ignore, {}, draft, source).materials.empty());
  CHECK(draft.scene.materials.size() == 3);
}

TEST_CASE("scene meshes: each face of a mesh with materials needs one", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("m.mtl", "newmtl plain\nKd 1 1 1\n");
  const auto path =
      directory.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nusemtl plain\nf 1 3 2\n");
  SceneDraft draft;
  JsonSource source;
  CHECK(message_of<IoError>([&] { (void)glint::detail::load_obj(path, MtlUse::Read, {}, draft, source); }) ==
        path.string() + ": has faces without a material, expected one for each face");
}

TEST_CASE("scene meshes: triangles of a material that shines are lights, where they were placed", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("m.mtl", "newmtl plain\nKd 1 1 1\nnewmtl lamp\nKe 1 2 3\nnewmtl unused\nKe 1 1 1\n");
  const auto path = directory.write("m.obj",
                                    "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl plain\nf 1 2 3\nusemtl lamp\n"
                                    "f 1 3 2\nf 1 3 2\n");
  SceneDraft draft;
  JsonSource source;
  const auto mesh = glint::detail::load_obj(path, MtlUse::Read, Affine<float>::scale({2, 2, 2}), draft, source);
  CHECK(mesh.lights == std::vector<std::uint32_t>{glint::none<std::uint32_t>, 0, 1});
  REQUIRE(draft.scene.lights.size() == 2);
  const auto* light = draft.scene.lights[0].get_if<glint::AreaLight<glint::Triangle<float>>>();
  REQUIRE(light != nullptr);
  CHECK(area(light->shape) == 2);  // 2 · 2 / 2
  CHECK(light->radiance == Rgb{1, 2, 3});
}

TEST_CASE("scene meshes: a missing MTL file is an error where the scene names no material", "[io][scene]") {
  const TemporaryDirectory directory;
  const auto path = directory.write("m.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  SceneDraft draft;
  JsonSource source;
  const auto message =
      message_of<IoError>([&] { (void)glint::detail::load_obj(path, MtlUse::Read, {}, draft, source); });
  CHECK(message.find("has no materials, and the scene names none: ") != std::string::npos);
  CHECK(message.find((directory / "m.mtl").string() + ": cannot be read") != std::string::npos);
  CHECK(glint::detail::load_obj(path, MtlUse::Ignore, {}, draft, source).materials.empty());
}

TEST_CASE("scene meshes: other kinds of files are refused by name", "[io][scene]") {
  SceneDraft draft;
  JsonSource source;
  CHECK(message_of<IoError>([&] { (void)glint::detail::load_obj("a.ply", MtlUse::Ignore, {}, draft, source); }) ==
        "a.ply: cannot be read as a mesh: expected .obj");
  CHECK(message_of<IoError>([&] { (void)glint::detail::load_obj("no/such.OBJ", MtlUse::Ignore, {}, draft, source); }) ==
        "no/such.OBJ: cannot be read: No such file or directory");
}

}  // namespace test_io_scene_meshes

// SPDX-License-Identifier: MIT
#include <glint/io/mesh_obj.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <glm/geometric.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_mesh_obj {

namespace {

using glint::IoError;
using glint::ObjMesh;
using glint::read_obj;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;
using Indices = std::vector<std::uint32_t>;
using Positions = std::vector<glint::Vec3<float>>;
using Uvs = std::vector<glint::Vec2<float>>;

constexpr std::uint32_t no_material = glint::none<std::uint32_t>;
const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

ObjMesh parsed(std::string_view text) {
  const TemporaryDirectory directory;
  return read_obj(directory.write("mesh.obj", text));
}

double area(const glint::MeshBuffers<float>& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto a = mesh.positions[mesh.indices[i]];
    sum +=
        glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a)) / 2;
  }
  return sum;
}

}  // namespace

TEST_CASE("obj: positions and triangles are read, in the file's order", "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "v 0.5 0.25 -8\nf 1 2 3\nf 4 3 2\n");
  CHECK(mesh.buffers.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.5F, 0.25F, -8}});
  CHECK(mesh.buffers.indices == Indices{0, 1, 2, 3, 2, 1});
  CHECK(mesh.buffers.normals.empty());
  CHECK(mesh.buffers.uvs.empty());
  CHECK(mesh.material_ids == Indices{no_material, no_material});
  CHECK(mesh.materials.empty());
  CHECK(mesh.warnings.empty());
}

TEST_CASE("obj: corners share a vertex only where position, uv and normal agree", "[io][obj]") {
  const std::string attributes = triangle + "vt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 0 2\n";
  const ObjMesh shared = parsed(attributes + "f 1/1/1 2/1/1 3/1/1\nf 1/1/1 2/1/1 3/1/1\n");
  CHECK(shared.buffers.indices == Indices{0, 1, 2, 0, 1, 2});
  const ObjMesh split = parsed(attributes + "f 1/1/1 2/1/1 3/1/1\nf 1/2/1 2/1/2 3/1/1\n");
  CHECK(split.buffers.indices == Indices{0, 1, 2, 3, 4, 2});
  CHECK(split.buffers.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}});
  CHECK(split.buffers.uvs == Uvs{{0, 0}, {0, 0}, {0, 0}, {1, 1}, {0, 0}});
  CHECK(split.buffers.normals == Positions{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 2}});
}

TEST_CASE("obj: positions that no face uses are left out", "[io][obj]") {
  CHECK(parsed("v 9 9 9\n" + triangle + "f 2 3 4\n").buffers.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("obj: negative indices count back from the line they are on", "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "f -3 -2 -1\nv 0 0 1\nf -4 -3 -1\n");
  CHECK(mesh.buffers.indices == Indices{0, 1, 2, 0, 1, 3});
}

TEST_CASE("obj: a triangle wound against its first normal has its corners 2 and 3 swapped, with their uvs",
          "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "vt 0 0\nvt 0.5 0\nvt 0 0.75\nvn 0 0 -1\nf 1/1/1 2/2/1 3/3/1\n");
  CHECK(mesh.buffers.positions == Positions{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}});
  CHECK(mesh.buffers.uvs == Uvs{{0, 0}, {0, 0.75F}, {0.5F, 0}});
  const ObjMesh first_decides = parsed(triangle + "vn 0 0 1\nvn 0 0 -1\nf 1//1 2//2 3//2\n");
  CHECK(first_decides.buffers.positions == Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
}

TEST_CASE("obj: faces with and without normals live in one file: no normal is a zero vector", "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "vn 0 0 1\nf 1//1 2//1 3//1\nf 3 2 1\n");
  CHECK(mesh.buffers.indices == Indices{0, 1, 2, 3, 4, 5});
  CHECK(mesh.buffers.normals == Positions{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}});
}

TEST_CASE("obj: beside faces with uvs, one without gets (0,0), (1,0), (1,1)", "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "vt 0.5 0.5\nf 1/1 2/1 3/1\nf 1 2 3\nf 1/1 2 3/1\n");
  CHECK(mesh.buffers.uvs == Uvs{{0.5F, 0.5F}, {0.5F, 0.5F}, {0.5F, 0.5F}, {0, 0}, {1, 0}, {1, 1}});
  CHECK(mesh.buffers.indices == Indices{0, 1, 2, 3, 4, 5, 3, 4, 5});
}

TEST_CASE("obj: v stays as in the file", "[io][obj]") {
  CHECK(parsed(triangle + "vt 0.25 0.125\nf 1/1 2/1 3/1\n").buffers.uvs == Uvs(3, {0.25F, 0.125F}));
}

TEST_CASE("obj: polygons are cut into triangles that tile them, concave ones too", "[io][obj]") {
  // An L of three unit squares, away from the origin: area 3 of 4 triangles. All coordinates are exact.
  const ObjMesh mesh = parsed("v 5 5 1\nv 7 5 1\nv 7 6 1\nv 6 6 1\nv 6 7 1\nv 5 7 1\nf 1 2 3 4 5 6\n");
  CHECK(mesh.buffers.indices.size() == 12);
  CHECK(mesh.material_ids.size() == 4);
  CHECK(area(mesh.buffers) == 3);
}

TEST_CASE("obj: a polygon may have more corners than a byte counts", "[io][obj]") {
  std::string text;
  std::string face = "f";
  for (int i = 0; i < 600; ++i) {  // around a 150 x 150 square, one corner a unit
    const int side = i / 150;
    const int along = i % 150;
    const int x = side == 0 ? along : side == 1 ? 150 : side == 2 ? 150 - along : 0;
    const int y = side == 0 ? 0 : side == 1 ? along : side == 2 ? 150 : 150 - along;
    text.append("v ").append(std::to_string(x)).append(" ").append(std::to_string(y)).append(" 0\n");
    face.append(" ").append(std::to_string(i + 1));
  }
  const ObjMesh mesh = parsed(text + face + "\n" + "f 1 2 300\n");
  CHECK(mesh.buffers.indices.size() == 3 * (598 + 1));
  // The second face: from (0, 0) and (1, 0) to vertex 300 = (150, 149): base 1, height 149.
  CHECK(area(mesh.buffers) == Approx(150 * 150 + 149 / 2.0));
}

TEST_CASE("obj: groups and objects are merged", "[io][obj]") {
  const ObjMesh mesh = parsed(triangle + "o one\nf 1 2 3\ng two\nf 2 3 1\ns 1\nf 3 1 2\no three\nl 1 2\np 1\n");
  CHECK(mesh.buffers.indices == Indices{0, 1, 2, 1, 2, 0, 2, 0, 1});
}

TEST_CASE("obj: materials of the MTL file are read, and each triangle knows its own", "[io][obj]") {
  const TemporaryDirectory directory;
  directory.write("room.mtl",
                  "newmtl wall\nKd 0.5 0.25 0.125\nKs 0.1 0.2 0.3\nKe 1 2 3\nNs 32\nNi 1.5\nd 0.5\nillum 2\n"
                  "map_Kd textures\\wall.png\nmap_bump bump.png\nnewmtl glass\nTf 0.9 0.8 0.7\nTr 0.25\nmap_d a.png\n");
  const auto path = directory.write(
      "room.obj", "mtllib room.mtl\n" + triangle + "f 1 2 3\nusemtl glass\nf 1 2 3\nusemtl wall\nf 3 2 1\n");
  const ObjMesh mesh = read_obj(path);
  CHECK(mesh.material_ids == Indices{no_material, 1, 0});
  REQUIRE(mesh.materials.size() == 2);
  const glint::ObjMaterial wall{.name = "wall",
                                .diffuse = {0.5F, 0.25F, 0.125F},
                                .specular = {0.1F, 0.2F, 0.3F},
                                .emission = {1, 2, 3},
                                .transmission = {},
                                .shininess = 32,
                                .ior = 1.5F,
                                .opacity = 0.5F,
                                .roughness = 0,
                                .metallic = 0,
                                .illumination = 2,
                                .diffuse_map = directory / "textures/wall.png",
                                .specular_map = {},
                                .emission_map = {},
                                .opacity_map = {},
                                .normal_map = {},
                                .bump_map = directory / "bump.png"};
  CHECK(mesh.materials[0] == wall);
  CHECK(mesh.materials[1].name == "glass");
  CHECK(mesh.materials[1].transmission == glint::Rgb{0.9F, 0.8F, 0.7F});
  CHECK(mesh.materials[1].opacity == 0.75F);  // 1 − Tr
  CHECK(mesh.materials[1].opacity_map == directory / "a.png");
  CHECK(mesh.warnings.empty());
}

TEST_CASE("obj: a missing MTL file and a missing material are warnings, each once", "[io][obj]") {
  const TemporaryDirectory directory;
  const auto path =
      directory.write("room.obj", "mtllib lost.mtl\n" + triangle + "usemtl wall\nf 1 2 3\nusemtl wall\nf 1 2 3\n");
  const ObjMesh mesh = read_obj(path);
  CHECK(mesh.material_ids == Indices{no_material, no_material});
  REQUIRE(mesh.warnings.size() == 3);
  CHECK(mesh.warnings[0] ==
        path.string() + ": " + (directory / "lost.mtl").string() + ": cannot be read: No such file or directory");
  CHECK(mesh.warnings[2].find("wall") != std::string::npos);
}

TEST_CASE("obj: mistakes name file and line", "[io][obj]") {
  const TemporaryDirectory directory;
  const auto message = [&](const std::string& text) {
    const auto path = directory.write("m.obj", text);
    return message_of<IoError>([&] { (void)read_obj(path); }, path.string());
  };
  CHECK(message(triangle + "f 1 2 99\n") == ":4: face refers to vertex 99, but the file has 3 vertices");
  CHECK(message(triangle + "f 1 2 0\n").starts_with(":4: "));
  CHECK(message(triangle + "f 1 2\n").starts_with(":4: "));
  CHECK(message("v 0 nan 0\n").starts_with(":1: "));
  CHECK(message("").starts_with(": has no faces"));
  CHECK(message(triangle + "f 1 2 3\nl 0 1\n").starts_with(": cannot be parsed: "));
  CHECK(message("v 0e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").starts_with(": cannot be parsed: "));
}

TEST_CASE("obj: a missing file and a directory are errors", "[io][obj]") {
  const TemporaryDirectory directory;
  CHECK_THROWS_AS(read_obj(directory / "lost.obj"), IoError);
  CHECK_THROWS_AS(read_obj(directory.path()), IoError);
}

TEST_CASE("obj: any truncation of a file is a mesh or an error, never a crash", "[io][obj]") {
  const TemporaryDirectory directory;
  const std::string text = "mtllib a.mtl\no a\n" + triangle +
                           "vt 0 0\nvn 0 0 1\ng b\nusemtl c\nf 1/1/1 2/1/1 3/1/1\nf 1//1 2//1 -1//1\ns off\n";
  for (std::size_t size = 0; size < text.size(); ++size) {
    const auto path = directory.write("m.obj", text.substr(0, size));
    const std::string message = message_of<IoError>([&] { (void)read_obj(path); }, path.string());
    CHECK((message == "no error" || message.starts_with(":")));
  }
}

TEST_CASE("obj: the bunny of the reference scenes has its triangles", "[io][obj][shared]") {
  const auto path = glint::testing::shared_path("scenes/oracles/mesh/bunny.obj");
  if (!path) return;
  const ObjMesh mesh = read_obj(*path);
  CHECK(mesh.buffers.indices.size() == 3 * 69451);
  CHECK(mesh.buffers.positions.size() <= 35947);  // the scan's published number of vertices
}

TEST_CASE("obj: the course's meshes read without warnings but those of missing materials", "[io][obj][shared]") {
  const auto folder = glint::testing::shared_path("scenes/course/assets/cbox");
  if (!folder) return;
  for (const auto& entry : std::filesystem::directory_iterator(*folder)) {
    if (entry.path().extension() != ".obj") continue;
    CAPTURE(entry.path());
    CHECK_NOTHROW(read_obj(entry.path()));
  }
}

}  // namespace test_io_mesh_obj

// SPDX-License-Identifier: MIT
#include <glint/geometry/mesh_buffers.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

namespace test_geometry_mesh_buffers {

TEMPLATE_TEST_CASE("mesh buffers: are a value, empty at first", "[geometry][mesh_buffers]", float, double) {
  glint::MeshBuffers<TestType> mesh;
  CHECK(mesh.positions.empty());
  CHECK(mesh.indices.empty());
  mesh.positions.assign(3, glint::Vec3<TestType>(TestType(1)));
  mesh.indices = {0, 1, 2};
  auto copy = mesh;
  CHECK(copy == mesh);
  copy.indices[2] = 1;
  CHECK_FALSE(copy == mesh);
}

}  // namespace test_geometry_mesh_buffers

// SPDX-License-Identifier: MIT
#include <glint/geometry/triangle_mesh.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glint/core/strided.hpp>
#include <glint/geometry/concepts.hpp>

#include <support/catch.hpp>
#include <support/closed_meshes.hpp>

namespace test_geometry_triangle_mesh {

namespace {

using glint::MeshBuffers;
using glint::Ray;
using glint::TriangleMesh;
using glint::Vec2;
using glint::Vec3;

static_assert(glint::PreparedSet<TriangleMesh<float>> && glint::ShadableSet<TriangleMesh<float>>);
static_assert(glint::ClippableSet<TriangleMesh<float>>);
static_assert(glint::PreparedSet<TriangleMesh<double, std::uint16_t, glint::MoellerTrumbore>>);

/// A square in the plane z = 0, of two triangles.
template <typename T>
MeshBuffers<T> square() {
  MeshBuffers<T> mesh;
  mesh.positions = {{T(0), T(0), T(0)}, {T(2), T(0), T(0)}, {T(2), T(2), T(0)}, {T(0), T(2), T(0)}};
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return mesh;
}

template <typename T>
Ray<T> down_to(T x, T y) {
  return {{x, y, T(1)}, {T(0), T(0), T(-1)}};
}

}  // namespace

TEMPLATE_TEST_CASE("mesh: hits carry the triangle's index, alike with and without a prepared ray",
                   "[geometry][triangle_mesh]", float, double) {
  using T = TestType;
  const MeshBuffers<T> buffers = square<T>();
  const auto mesh = view(buffers);
  REQUIRE(mesh.size() == 2);
  const Ray<T> ray = down_to(T(0.5), T(1.5));  // above the diagonal: the second triangle
  CHECK_FALSE(mesh.intersect(ray, 0));
  const auto hit = mesh.intersect(ray, 1);
  REQUIRE(hit);
  CHECK(hit->primitive == 1);
  CHECK(hit->t == T(1));
  CHECK(mesh.intersect(ray, mesh.prepare(ray), 1) == hit);
  CHECK(view<glint::MoellerTrumbore>(buffers).intersect(ray, 1) == hit);
  CHECK(mesh.bounds(1) == bounds(mesh.triangle(1)));
  CHECK(mesh.vertices(1)[2] == buffers.positions[3]);
}

TEMPLATE_TEST_CASE("mesh: views any vertex layout and either width of indices", "[geometry][triangle_mesh]", float,
                   double) {
  using T = TestType;
  struct Vertex {
    char tag = 'v';
    Vec3<T> position{T(0)};
    Vec2<T> uv{T(0)};
  };
  const MeshBuffers<T> buffers = square<T>();
  std::vector<Vertex> vertices;
  for (const Vec3<T>& p : buffers.positions) vertices.push_back({'v', p, {p.x, p.y}});
  const std::vector<std::uint16_t> indices(buffers.indices.begin(), buffers.indices.end());
  const TriangleMesh<T, std::uint16_t> mesh{
      .positions = glint::strided_member(std::span(std::as_const(vertices)), &Vertex::position),
      .triangles = {indices.data(), indices.size() / 3},
      .uvs = glint::strided_member(std::span(std::as_const(vertices)), &Vertex::uv)};
  REQUIRE(mesh.size() == 2);
  const Ray<T> ray = down_to(T(1.5), T(0.5));
  CHECK(mesh.intersect(ray, 0) == view(buffers).intersect(ray, 0));
  const auto hit = mesh.intersect(ray, 0);
  REQUIRE(hit);
  const auto s = mesh.surface(ray, *hit);
  CHECK(s.uv == Vec2<T>{T(1.5), T(0.5)});         // uv = (x, y) at every vertex, hence everywhere
  CHECK(s.tangent == Vec3<T>{T(1), T(0), T(0)});  // so u grows along x, at rate 1
  CHECK(s.bitangent == Vec3<T>{T(0), T(1), T(0)});
  CHECK(s.position == Vec3<T>{T(1.5), T(0.5), T(0)});
}

TEMPLATE_TEST_CASE("mesh: without normals and uvs the triangle's own are used", "[geometry][triangle_mesh]", float,
                   double) {
  using T = TestType;
  const MeshBuffers<T> buffers = square<T>();
  const auto mesh = view(buffers);
  const Ray<T> ray = down_to(T(1.5), T(0.5));
  const auto hit = mesh.intersect(ray, 0);
  REQUIRE(hit);
  CHECK(mesh.surface(ray, *hit) == surface(mesh.triangle(0), ray.at(hit->t), *hit));
}

TEMPLATE_TEST_CASE("mesh: the shading normal is interpolated, where vertices have one", "[geometry][triangle_mesh]",
                   float, double) {
  using T = TestType;
  MeshBuffers<T> buffers = square<T>();
  const Ray<T> ray = down_to(T(1.5), T(0.5));  // weights: v0 1/4, v1 1/2, v2 1/4
  buffers.normals = {{T(0), T(0), T(1)}, {T(1), T(0), T(0)}, {T(0), T(0), T(1)}, {T(0), T(0), T(1)}};
  const auto hit = view(buffers).intersect(ray, 0);
  REQUIRE(hit);
  const auto s = view(buffers).surface(ray, *hit);
  CHECK(s.normal == Vec3<T>{T(0), T(0), T(1)});
  // 1/4 z + 1/2 x + 1/4 z = (1/2, 0, 1/2)
  CHECK(glm::length(s.shading_normal - Vec3<T>{std::sqrt(T(0.5)), T(0), std::sqrt(T(0.5))}) < T(1e-6));
  buffers.normals.assign(4, Vec3<T>(T(0)));
  CHECK(view(buffers).surface(ray, *hit).shading_normal == s.normal);
}

TEMPLATE_TEST_CASE("mesh: the tangents follow the uvs, and are zero where they span no area",
                   "[geometry][triangle_mesh]", float, double) {
  using T = TestType;
  MeshBuffers<T> buffers = square<T>();
  const Ray<T> ray = down_to(T(1.5), T(0.5));
  const auto hit = view(buffers).intersect(ray, 0);
  REQUIRE(hit);
  // u = y / 4, v = −x: the position moves by 4 along y as u grows by 1 and v stays, and along −x as v grows.
  for (const Vec3<T>& p : buffers.positions) buffers.uvs.push_back({p.y / T(4), -p.x});
  CHECK(view(buffers).surface(ray, *hit).tangent == Vec3<T>{T(0), T(4), T(0)});
  CHECK(view(buffers).surface(ray, *hit).bitangent == Vec3<T>{T(-1), T(0), T(0)});
  for (Vec2<T>& uv : buffers.uvs) uv.y = uv.x;
  CHECK(view(buffers).surface(ray, *hit).tangent == Vec3<T>(T(0)));
  CHECK(view(buffers).surface(ray, *hit).bitangent == Vec3<T>(T(0)));
  buffers.uvs.assign(4, Vec2<T>(T(0.5)));
  CHECK(view(buffers).surface(ray, *hit).tangent == Vec3<T>(T(0)));
  CHECK(view(buffers).surface(ray, *hit).uv == Vec2<T>(T(0.5)));
}

TEMPLATE_TEST_CASE("mesh: all triangles of a sphere face outward", "[geometry][triangle_mesh]", float, double) {
  using T = TestType;
  const auto buffers = glint::testing::subdivided_sphere<T>(2);
  const auto mesh = view(buffers);
  REQUIRE(mesh.size() == 8 * 16);
  for (std::uint32_t i = 0; i < mesh.size(); ++i) {
    const auto s = surface_at(mesh.triangle(i), T(0.3), T(0.3));
    CHECK(glm::dot(s.normal, s.position) > T(0));
  }
}

TEMPLATE_TEST_CASE("mesh: a triangle is clipped as one that stands alone", "[geometry][triangle_mesh]", float, double) {
  using T = TestType;
  const MeshBuffers<T> buffers = square<T>();
  const glint::Aabb<T> cell{{T(0), T(0), T(-1)}, {T(1), T(0.5), T(1)}};
  CHECK(view(buffers).clip(0, cell) == clip(view(buffers).triangle(0), cell));
  CHECK_FALSE(is_empty(view(buffers).clip(1, cell)));
}

}  // namespace test_geometry_triangle_mesh

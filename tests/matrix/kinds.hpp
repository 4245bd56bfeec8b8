// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <glint/geometry/bilinear_patch.hpp>
#include <glint/geometry/box.hpp>
#include <glint/geometry/capsule.hpp>
#include <glint/geometry/cone.hpp>
#include <glint/geometry/cylinder.hpp>
#include <glint/geometry/disk.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/round_curve.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

/// The kinds of primitives that the matrix is over. `KIND<T>()` has few of them in storage, which `with_set(storage,
/// f)` shows to f as a set. They overlap, so that rays meet several, and lie about the cube from −1 to 1.
namespace glint::testing::kinds {

inline constexpr std::size_t count = 60;

/// `count` primitives by make(random, size), where `random` gives points and directions.
template <typename T, typename Make>
[[nodiscard]] auto some(std::uint64_t seed, const Make& make) {
  Random random(seed);
  const auto vec = [&] { return random.uniform_vec3<T>() * T(2) - T(1); };
  std::vector<decltype(make(vec, T()))> shapes;
  for (std::size_t i = 0; i < count; ++i) shapes.push_back(make(vec, random.uniform(T(0.1), T(0.4))));
  return shapes;
}

template <typename T>
[[nodiscard]] auto spheres() {
  return some<T>(1, [](const auto& vec, T size) { return Sphere<T>{.center = vec(), .radius = size}; });
}
template <typename T>
[[nodiscard]] auto boxes() {
  return some<T>(2, [](const auto& vec, T size) {
    const Vec3<T> lower = vec();
    return Box<T>{lower, lower + abs(vec()) * (T(2) * size)};
  });
}
template <typename T>
[[nodiscard]] auto quads() {
  return some<T>(3, [](const auto& vec, T size) {
    const Vec3<T> corner = vec();
    const Vec3<T> edge = vec() * (T(2) * size);
    return Quad<T>{corner, edge, vec() * (T(2) * size)};
  });
}
template <typename T>
[[nodiscard]] auto disks() {
  return some<T>(4, [](const auto& vec, T size) {
    const Vec3<T> center = vec();
    return Disk<T>{.center = center, .normal = normalized(vec()), .radius = size};
  });
}
template <typename T>
[[nodiscard]] auto triangles() {
  return some<T>(5, [](const auto& vec, T size) {
    const Vec3<T> corner = vec();
    const Vec3<T> second = corner + vec() * (T(6) * size);
    return Triangle<T>{corner, second, corner + vec() * (T(6) * size)};
  });
}

template <typename T>
[[nodiscard]] auto cylinders() {
  return some<T>(6, [](const auto& vec, T size) {
    const Vec3<T> base = vec();
    return Cylinder<T>{.base = base, .top = base + vec() * size, .radius = size / 2};
  });
}
template <typename T>
[[nodiscard]] auto cones() {
  return some<T>(7, [](const auto& vec, T size) {
    const Vec3<T> base = vec();
    return Cone<T>{.base = base, .top = base + vec() * size, .base_radius = size, .top_radius = size / 4};
  });
}
template <typename T>
[[nodiscard]] auto capsules() {
  return some<T>(8, [](const auto& vec, T size) {
    const Vec3<T> start = vec();
    return Capsule<T>{.start = start, .end = start + vec() * size, .radius = size / 2};
  });
}

template <typename T>
[[nodiscard]] auto patches() {
  return some<T>(9, [](const auto& vec, T size) {
    const Vec3<T> corner = vec();
    const Vec3<T> u = vec() * (T(4) * size);
    const Vec3<T> v = vec() * (T(4) * size);
    return BilinearPatch<T>{corner, corner + u, corner + v, corner + u + v + vec() * size};
  });
}
template <typename T>
[[nodiscard]] auto curves() {
  return some<T>(10, [](const auto& vec, T size) {
    const Vec3<T> start = vec();
    const Vec3<T> step = normalized(vec()) * T(0.4);
    const Vec3<T> bend = normalized(vec()) * T(0.05);
    BezierCurve<T> curve;
    for (std::size_t i = 0; i < 4; ++i) curve.points[i] = {start + step * T(i) + bend * T(i * (3 - i)), size * T(0.25)};
    return RoundCurve<T>{curve};
  });
}

/// Triangles that a mesh has in buffers, and the test they are asked with.
template <typename T, typename Test>
struct MeshOf {
  MeshBuffers<T> buffers;
};
template <typename T, typename Test>
[[nodiscard]] MeshOf<T, Test> mesh_with() {
  MeshOf<T, Test> mesh;
  for (const Triangle<T>& triangle : triangles<T>()) {
    for (const Vec3<T>& vertex : {triangle.v0, triangle.v1, triangle.v2}) {
      mesh.buffers.indices.push_back(static_cast<std::uint32_t>(mesh.buffers.positions.size()));
      mesh.buffers.positions.push_back(vertex);
    }
  }
  return mesh;
}
template <typename T>
[[nodiscard]] auto watertight_mesh() {
  return mesh_with<T, Watertight>();
}
template <typename T>
[[nodiscard]] auto moeller_trumbore_mesh() {
  return mesh_with<T, MoellerTrumbore>();
}

/// A primitive of any kind: what it answers is looked up while the program runs.
template <typename T>
struct AnyPrimitive {
  Aabb<T> box{};
  std::function<std::optional<Hit<T>>(const Ray<T>&)> intersect;
};
template <typename T>
[[nodiscard]] Aabb<T> bounds(const AnyPrimitive<T>& any) {
  return any.box;
}
template <typename T>
[[nodiscard]] std::optional<Hit<T>> intersect(const Ray<T>& ray, const AnyPrimitive<T>& any) {
  return any.intersect(ray);
}

/// Some of each kind.
template <typename T>
[[nodiscard]] std::vector<AnyPrimitive<T>> mixture() {
  std::vector<AnyPrimitive<T>> all;
  const auto add = [&](const auto& shapes) {
    for (std::size_t i = 0; i < 10; ++i) {
      const auto shape = shapes[i];
      all.push_back({bounds(shape), [shape](const Ray<T>& ray) { return intersect(ray, shape); }});
    }
  };
  add(spheres<T>());
  add(boxes<T>());
  add(quads<T>());
  add(disks<T>());
  add(triangles<T>());
  add(cylinders<T>());
  add(cones<T>());
  add(capsules<T>());
  add(patches<T>());
  add(curves<T>());
  return all;
}

template <typename P, typename F>
void with_set(const std::vector<P>& shapes, const F& f) {
  f(Elements{shapes});
}
template <typename T, typename Test, typename F>
void with_set(const MeshOf<T, Test>& mesh, const F& f) {
  f(view<Test>(mesh.buffers));
}

}  // namespace glint::testing::kinds

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>
#include <glint/testing/random_rays.hpp>

/// Meshes made by rule, for tests and benchmarks: each is hard for some builder or traversal in its own way.
///
/// All lie in scene_box(), and equal arguments give equal meshes. Counts must stay below 2³² / 3.
namespace glint::testing {

/// The cube from −1 to 1.
template <std::floating_point T = float>
[[nodiscard]] Aabb<T> scene_box() {
  return {Vec3<T>(T(-1)), Vec3<T>(T(1))};
}

namespace detail {

template <std::floating_point T>
void add_triangle(MeshBuffers<T>& mesh, const Vec3<T>& v0, const Vec3<T>& v1, const Vec3<T>& v2) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), {v0, v1, v2});
  mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2});
}

template <std::floating_point T>
[[nodiscard]] MeshBuffers<T> room_for(std::size_t triangles) {
  MeshBuffers<T> mesh;
  mesh.positions.reserve(3 * triangles);
  mesh.indices.reserve(3 * triangles);
  return mesh;
}

/// Smooth noise in [−1, 1]: plane waves of random direction, each octave half as high and twice as fine.
template <std::floating_point T>
class Waves {
 public:
  explicit Waves(Random& random) {
    for (std::size_t i = 0; i < count_; ++i) {
      const T frequency = T(2 << (i / 2));
      waves_[i] = (random.uniform_vec3<T>() * T(2) - T(1)) * frequency;
      phases_[i] = random.uniform(T(0), T(2) * pi<T>);
    }
  }

  [[nodiscard]] T operator()(const Vec3<T>& p) const {
    T sum = 0;
    T height = T(0.25);
    for (std::size_t i = 0; i < count_; i += 2) {
      sum += height *
             (std::sin(glm::dot(waves_[i], p) + phases_[i]) + std::sin(glm::dot(waves_[i + 1], p) + phases_[i + 1]));
      height /= 2;
    }
    return sum;
  }

 private:
  static constexpr std::size_t count_ = 10;
  std::array<Vec3<T>, count_> waves_;
  std::array<T, count_> phases_;
};

}  // namespace detail

/// Small triangles strewn about, no two connected; the more there are, the smaller.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> triangle_soup(std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  MeshBuffers<T> mesh = detail::room_for<T>(triangles);
  const T size = T(0.5) / std::cbrt(T(triangles + 1));
  const Aabb<T> centers{Vec3<T>(size - T(1)), Vec3<T>(T(1) - size)};
  const Aabb<T> around{Vec3<T>(-size), Vec3<T>(size)};
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3<T> center = detail::random_point(centers, random);
    const Vec3<T> v0 = center + detail::random_point(around, random);
    const Vec3<T> v1 = center + detail::random_point(around, random);
    const Vec3<T> v2 = center + detail::random_point(around, random);
    detail::add_triangle(mesh, v0, v1, v2);
  }
  return mesh;
}

/// Long thin triangles along the cube's diagonals: their boxes are almost all empty and all overlap.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> diagonal_slivers(std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  MeshBuffers<T> mesh = detail::room_for<T>(triangles);
  const Aabb<T> spread{Vec3<T>(T(-0.2)), Vec3<T>(T(0.2))};
  for (std::size_t i = 0; i < triangles; ++i) {
    const std::uint32_t corner = random.below(4);
    const Vec3<T> diagonal{corner % 2 == 0 ? T(0.8) : T(-0.8), corner / 2 == 0 ? T(0.8) : T(-0.8), T(0.8)};
    const Vec3<T> shift = detail::random_point(spread, random) * T(0.9);
    const Vec3<T> across = detail::random_point(spread, random) * T(0.01);
    detail::add_triangle<T>(mesh, shift - diagonal, shift + diagonal, shift + across);
  }
  return mesh;
}

/// The same triangle again and again: no split tells them apart.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> identical_triangles(std::size_t triangles) {
  MeshBuffers<T> mesh;
  mesh.positions = {{T(-0.5), T(-0.5), T(0.25)}, {T(0.5), T(-0.25), T(0)}, {T(0), T(0.5), T(-0.25)}};
  mesh.indices.reserve(3 * triangles);
  for (std::size_t i = 0; i < triangles; ++i) mesh.indices.insert(mesh.indices.end(), {0U, 1U, 2U});
  return mesh;
}

/// Triangles of many sizes whose boxes all have their centroid at the origin, exactly.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> coincident_centroids(std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  MeshBuffers<T> mesh = detail::room_for<T>(triangles);
  for (std::size_t i = 0; i < triangles; ++i) {
    const Vec3<T> corner = detail::random_point(scene_box<T>(), random);
    const Vec3<T> within = corner * (random.uniform_vec3<T>() * T(2) - T(1));
    detail::add_triangle<T>(mesh, corner, -corner, within);
  }
  return mesh;
}

/// A triangle soup in which every second triangle is broken: repeated corners, collinear corners, a NaN, an infinity,
/// all in turn.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> degenerate_mix(std::size_t triangles, std::uint64_t seed) {
  MeshBuffers<T> mesh = triangle_soup<T>(triangles, seed);
  for (std::size_t i = 1; i < triangles; i += 2) {
    Vec3<T>* const v = &mesh.positions[3 * i];
    switch (i / 2 % 5) {
      case 0:
        v[1] = v[2] = v[0];
        break;
      case 1:
        v[2] = v[1];
        break;
      case 2:
        v[2] = v[0] + (v[1] - v[0]) * T(0.5);
        break;
      case 3:
        v[1].y = std::numeric_limits<T>::quiet_NaN();
        break;
      default:
        v[2].x = infinity<T>;
        break;
    }
  }
  return mesh;
}

namespace detail {

/// A sphere as an octahedron whose eight faces are cut into f² triangles each. Rings of points run around z, and share
/// their vertices.
class OctahedralGrid {
 public:
  explicit OctahedralGrid(std::uint32_t cuts) : cuts_(cuts) {
    std::uint32_t first = 0;
    for (std::uint32_t ring = 0; ring <= 2 * cuts; ++ring) {
      first_.push_back(first);
      first += std::max(1U, 4 * quarter(ring));
    }
  }

  template <std::floating_point T>
  [[nodiscard]] std::vector<Vec3<T>> directions() const {
    std::vector<Vec3<T>> result;
    result.reserve(first_.back() + 1);
    for (std::uint32_t ring = 0; ring <= 2 * cuts_; ++ring) {
      const std::uint32_t k = quarter(ring);
      const T z = T(cuts_) - T(ring);
      for (std::uint32_t i = 0; i < std::max(1U, 4 * k); ++i) {
        const std::uint32_t side = k == 0 ? 0 : i / k;
        const T b = T(i - side * k);
        const T a = T(k) - b;
        const T x = side % 2 == 0 ? a : -b;
        const T y = side % 2 == 0 ? b : a;
        result.push_back(glm::normalize(side < 2 ? Vec3<T>(x, y, z) : Vec3<T>(-x, -y, z)));
      }
    }
    return result;
  }

  /// Counterclockwise from outside.
  [[nodiscard]] std::vector<std::uint32_t> indices() const {
    std::vector<std::uint32_t> result;
    result.reserve(std::size_t{24} * cuts_ * cuts_);
    for (std::uint32_t ring = 0; ring < 2 * cuts_; ++ring) {
      const bool is_north = ring < cuts_;
      const std::uint32_t inner = is_north ? ring : ring + 1;  // nearer to its pole
      const std::uint32_t outer = is_north ? ring + 1 : ring;
      for (std::uint32_t side = 0; side < 4; ++side) add_strip(result, side, inner, outer, is_north);
    }
    return result;
  }

 private:
  /// Points of a ring on one of four sides.
  [[nodiscard]] std::uint32_t quarter(std::uint32_t ring) const { return ring <= cuts_ ? ring : 2 * cuts_ - ring; }

  [[nodiscard]] std::uint32_t vertex(std::uint32_t ring, std::uint32_t side, std::uint32_t i) const {
    const std::uint32_t k = quarter(ring);
    return first_[ring] + (k == 0 ? 0 : (side * k + i) % (4 * k));
  }

  void add_strip(std::vector<std::uint32_t>& to, std::uint32_t side, std::uint32_t inner, std::uint32_t outer,
                 bool is_north) const {
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      to.insert(to.end(), {a, is_north ? b : c, is_north ? c : b});
    };
    const std::uint32_t k = quarter(inner);
    for (std::uint32_t i = 0; i <= k; ++i) {
      const std::uint32_t tip = vertex(inner, side, i);
      const std::uint32_t next = vertex(outer, side, i + 1);
      add(tip, vertex(outer, side, i), next);
      if (i < k) add(tip, next, vertex(inner, side, i + 1));
    }
  }

  std::uint32_t cuts_;
  std::vector<std::uint32_t> first_;
};

}  // namespace detail

/// A closed lump of connected triangles about alike in size, like the scan of a statue.
///
/// Ensures: 8 f² triangles, for the f that comes nearest to the number asked for; watertight; outer sides outward.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> scanned_blob(std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  const detail::Waves<T> noise(random);
  const auto cuts = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(double(triangles) / 8))));
  const detail::OctahedralGrid grid(cuts);
  MeshBuffers<T> mesh;
  mesh.positions = grid.directions<T>();
  mesh.indices = grid.indices();
  for (Vec3<T>& p : mesh.positions) p *= T(0.7) + T(0.28) * noise(p * T(2));
  return mesh;
}

/// A hilly height field over the xz plane, y up.
///
/// Ensures: 2 f² triangles, for the f that comes nearest to the number asked for; outer sides upward.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> terrain(std::size_t triangles, std::uint64_t seed) {
  Random random(seed);
  const detail::Waves<T> noise(random);
  const auto cells = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(double(triangles) / 2))));
  const std::uint32_t row = cells + 1;
  MeshBuffers<T> mesh;
  mesh.positions.reserve(std::size_t{row} * row);
  mesh.indices.reserve(std::size_t{6} * cells * cells);
  for (std::uint32_t j = 0; j < row; ++j) {
    for (std::uint32_t i = 0; i < row; ++i) {
      const Vec3<T> p{T(2) * T(i) / T(cells) - T(1), T(0), T(2) * T(j) / T(cells) - T(1)};
      mesh.positions.emplace_back(p.x, T(0.3) * noise(p * T(3)), p.z);
    }
  }
  for (std::uint32_t j = 0; j < cells; ++j) {
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * row + i;
      mesh.indices.insert(mesh.indices.end(), {a, a + row, a + 1, a + 1, a + row, a + row + 1});
    }
  }
  return mesh;
}

/// Twelve triangles, watertight, outer sides outward.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> closed_cube() {
  MeshBuffers<T> mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.positions.emplace_back((i & 1U) != 0 ? T(1) : T(-1), (i & 2U) != 0 ? T(1) : T(-1),
                                (i & 4U) != 0 ? T(1) : T(-1));
  }
  mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4,
                  2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
  return mesh;
}

/// Four triangles, watertight, outer sides outward.
template <std::floating_point T = float>
[[nodiscard]] MeshBuffers<T> closed_tetrahedron() {
  MeshBuffers<T> mesh;
  mesh.positions = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};
  mesh.indices = {0, 1, 2, 0, 2, 3, 0, 3, 1, 1, 3, 2};
  return mesh;
}

}  // namespace glint::testing

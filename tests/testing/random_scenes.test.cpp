// SPDX-License-Identifier: MIT
#include <glint/testing/random_scenes.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <map>
#include <utility>

#include <support/catch.hpp>

namespace test_testing_random_scenes {

namespace {

namespace scenes = glint::testing;

template <typename T>
std::array<glint::Vec3<T>, 3> corners(const glint::MeshBuffers<T>& mesh, std::size_t i) {
  return {mesh.positions[mesh.indices[3 * i]], mesh.positions[mesh.indices[3 * i + 1]],
          mesh.positions[mesh.indices[3 * i + 2]]};
}

template <typename T>
std::size_t size(const glint::MeshBuffers<T>& mesh) {
  return mesh.indices.size() / 3;
}

template <typename T>
bool is_within_scene_box(const glint::MeshBuffers<T>& mesh) {
  const auto box = scenes::scene_box<T>();
  return std::all_of(mesh.positions.begin(), mesh.positions.end(), [&](const auto& p) { return contains(box, p); }) &&
         std::all_of(mesh.indices.begin(), mesh.indices.end(), [&](auto i) { return i < mesh.positions.size(); });
}

/// Each edge is there once in each direction: no hole, no seam, one side outward.
template <typename T>
bool is_watertight(const glint::MeshBuffers<T>& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) ++edges[{mesh.indices[i + k], mesh.indices[i + (k + 1) % 3]}];
  }
  return std::all_of(edges.begin(), edges.end(), [&](const auto& edge) {
    const auto opposite = edges.find({edge.first.second, edge.first.first});
    return edge.second == 1 && opposite != edges.end();
  });
}

/// Six times the volume enclosed, positive where outer sides are outward.
template <typename T>
double volume(const glint::MeshBuffers<T>& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < size(mesh); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    sum += glm::dot(glint::Vec3<double>(a), glm::cross(glint::Vec3<double>(b), glint::Vec3<double>(c)));
  }
  return sum / 6;
}

template <typename T>
T area(const std::array<glint::Vec3<T>, 3>& t) {
  return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2;
}

}  // namespace

TEMPLATE_TEST_CASE("random scenes: have the number of triangles asked for, all in the scene box", "[testing][scenes]",
                   float, double) {
  using T = TestType;
  const auto count = GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{1000});
  CAPTURE(count);
  for (const auto& mesh : {scenes::triangle_soup<T>(count, 1), scenes::diagonal_slivers<T>(count, 1),
                           scenes::identical_triangles<T>(count), scenes::coincident_centroids<T>(count, 1)}) {
    CHECK(size(mesh) == count);
    CHECK(is_within_scene_box(mesh));
  }
  CHECK(size(scenes::degenerate_mix<T>(count, 1)) == count);
}

TEST_CASE("random scenes: depend on the seed and on nothing else", "[testing][scenes]") {
  CHECK(scenes::triangle_soup(100, 1) == scenes::triangle_soup(100, 1));
  CHECK_FALSE(scenes::triangle_soup(100, 1) == scenes::triangle_soup(100, 2));
  CHECK(scenes::scanned_blob(100, 1) == scenes::scanned_blob(100, 1));
  CHECK_FALSE(scenes::scanned_blob(100, 1) == scenes::scanned_blob(100, 2));
  CHECK(scenes::terrain(100, 1) == scenes::terrain(100, 1));
  CHECK_FALSE(scenes::terrain(100, 1) == scenes::terrain(100, 2));
  CHECK_FALSE(scenes::diagonal_slivers(100, 1) == scenes::diagonal_slivers(100, 2));
  CHECK_FALSE(scenes::coincident_centroids(100, 1) == scenes::coincident_centroids(100, 2));
}

TEMPLATE_TEST_CASE("random scenes: a scanned blob is closed, bumpy, and cut into even triangles", "[testing][scenes]",
                   float, double) {
  const auto mesh = scenes::scanned_blob<TestType>(1000, 3);
  CHECK(size(mesh) == 968);             // 8 · 11², the nearest
  CHECK(mesh.positions.size() == 486);  // Euler: V = 2 + F / 2
  CHECK(is_within_scene_box(mesh));
  CHECK(is_watertight(mesh));
  CHECK(volume(mesh) > 0.3);
  std::vector<TestType> radii;
  for (const auto& p : mesh.positions) radii.push_back(glm::length(p));
  const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
  CHECK(*least > TestType(0.1));
  CHECK(*most - *least > TestType(0.1));
  TestType largest = 0;
  for (std::size_t i = 0; i < size(mesh); ++i) largest = std::max(largest, area(corners(mesh, i)));
  CHECK(largest < TestType(10 * 4 * 3.15 / 968));  // ten times an even share of the unit sphere
}

TEST_CASE("random scenes: blobs of any size are closed", "[testing][scenes]") {
  for (const std::size_t count : {0U, 8U, 32U, 72U, 128U}) {
    const auto mesh = scenes::scanned_blob(count, 1);
    CHECK(size(mesh) == std::max<std::size_t>(count, 8));
    CHECK(is_watertight(mesh));
    CHECK(volume(mesh) > 0);
  }
}

TEST_CASE("random scenes: all of a terrain faces up, and its cells share their vertices", "[testing][scenes]") {
  const auto mesh = scenes::terrain(1000, 5);
  CHECK(size(mesh) == 968);                 // 2 · 22²
  CHECK(mesh.positions.size() == 23 * 23);  // one more a row than cells
  CHECK(is_within_scene_box(mesh));
  float ground = 0;
  for (std::size_t i = 0; i < size(mesh); ++i) {
    const auto [a, b, c] = corners(mesh, i);
    const float up = glm::cross(b - a, c - a).y;  // twice the area seen from above
    CHECK(up > 0.0F);
    ground += up / 2;
  }
  CHECK(ground == Approx(4.0F));
}

TEST_CASE("random scenes: slivers are long and thin and fill little of their boxes", "[testing][scenes]") {
  const auto mesh = scenes::diagonal_slivers(100, 5);
  for (std::size_t i = 0; i < size(mesh); ++i) {
    const auto t = corners(mesh, i);
    const float length = glm::length(t[1] - t[0]);
    CHECK(length > 2.0F);
    CHECK(area(t) < 0.01F * length);
    const auto span = glint::abs(t[1] - t[0]);
    CHECK(std::min({span.x, span.y, span.z}) > 1.5F);
  }
}

TEMPLATE_TEST_CASE("random scenes: coincident centroids are at the origin to the bit", "[testing][scenes]", float,
                   double) {
  const auto mesh = scenes::coincident_centroids<TestType>(500, 5);
  for (std::size_t i = 0; i < size(mesh); ++i) {
    glint::Aabb<TestType> box;
    for (const auto& p : corners(mesh, i)) extend(box, p);
    CHECK(centroid(box) == glint::Vec3<TestType>(TestType(0)));
  }
}

TEST_CASE("random scenes: half of the degenerate mix is broken, in each of the ways", "[testing][scenes]") {
  const auto mesh = scenes::degenerate_mix(1000, 5);
  int sound = 0;
  int flat = 0;
  int unordered = 0;
  int unbounded = 0;
  for (std::size_t i = 0; i < size(mesh); ++i) {
    const auto t = corners(mesh, i);
    const auto sum = t[0] + t[1] + t[2];
    const float scale = glm::length(t[1] - t[0]);
    if (std::isnan(sum.y)) {
      ++unordered;
    } else if (std::isinf(sum.x)) {
      ++unbounded;
    } else if (area(t) <= 1e-6F * scale) {
      ++flat;
    } else {
      ++sound;
    }
  }
  CHECK(sound == 500);
  CHECK(flat == 300);
  CHECK(unordered == 100);
  CHECK(unbounded == 100);
}

TEMPLATE_TEST_CASE("random scenes: cube and tetrahedron are closed", "[testing][scenes]", float, double) {
  const auto cube = scenes::closed_cube<TestType>();
  CHECK(size(cube) == 12);
  CHECK(is_watertight(cube));
  CHECK(volume(cube) == Approx(8.0));
  const auto tetrahedron = scenes::closed_tetrahedron<TestType>();
  CHECK(size(tetrahedron) == 4);
  CHECK(is_watertight(tetrahedron));
  CHECK(volume(tetrahedron) == Approx(8.0 / 3));  // the cube without four corners of a sixth each
}

}  // namespace test_testing_random_scenes

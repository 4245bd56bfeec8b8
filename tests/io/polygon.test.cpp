// SPDX-License-Identifier: MIT
#include <glint/io/polygon.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/math/constants.hpp>
#include <support/catch.hpp>

namespace test_io_polygon {

namespace {

using Vec3 = glint::Vec3<float>;
using Vec3d = glint::Vec3<double>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles cut(const std::vector<Vec3>& corners) {
  return glint::detail::PolygonCutter{}.cut(corners);
}

Vec3d doubled_area(const std::vector<Vec3>& corners, const std::array<std::uint32_t, 3>& t) {
  const Vec3d a(corners[t[0]]);
  return glm::cross(Vec3d(corners[t[1]]) - a, Vec3d(corners[t[2]]) - a);
}

/// A polygon seen from the origin of its plane without crossing itself, so that its exact area is a sum over corners.
std::vector<Vec3> star(std::uint32_t seed, int count) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> uniform(0, 1);
  const Vec3 center{10 * uniform(random), -5, 20 * uniform(random)};
  const Vec3 u = glm::normalize(Vec3{uniform(random), uniform(random), 0.3F});
  const Vec3 v = glm::normalize(glm::cross(u, Vec3{uniform(random), -0.7F, uniform(random)}));
  std::vector<Vec3> corners;
  for (int i = 0; i < count; ++i) {
    const float angle = 2 * glint::pi<float> * static_cast<float>(i) / static_cast<float>(count);
    const float radius = 0.2F + uniform(random);
    corners.push_back(center + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  return corners;
}

}  // namespace

TEST_CASE("polygon: a triangle is itself", "[io][polygon]") {
  CHECK(cut({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}) == Triangles{{0, 1, 2}});
}

TEST_CASE("polygon: a convex quad is split along its shorter diagonal", "[io][polygon]") {
  CHECK(cut({{0, 0, 0}, {3, -1, 0}, {4, 0, 0}, {3, 1, 0}}) == Triangles{{0, 1, 3}, {1, 2, 3}});  // 2 against 4
  CHECK(cut({{3, -1, 0}, {4, 0, 0}, {3, 1, 0}, {0, 0, 0}}) == Triangles{{0, 1, 2}, {0, 2, 3}});
}

TEST_CASE("polygon: a concave quad is split along the diagonal inside, though it is the longer one", "[io][polygon]") {
  // An arrowhead: the corner (1, 0) is reflex. Its diagonal to (4, 0), of length 3, lies inside; the other, from
  // (0, 1) to (0, -1), of length 2, outside.
  CHECK(cut({{1, 0, 0}, {0, -1, 0}, {4, 0, 0}, {0, 1, 0}}) == Triangles{{0, 1, 2}, {0, 2, 3}});
  CHECK(cut({{0, -1, 0}, {4, 0, 0}, {0, 1, 0}, {1, 0, 0}}) == Triangles{{0, 1, 3}, {1, 2, 3}});
}

TEST_CASE("polygon: triangles tile concave polygons in any plane, wound alike", "[io][polygon]") {
  const auto seed = GENERATE(range(0U, 200U));
  CAPTURE(seed);
  const auto corners = star(seed, 4 + static_cast<int>(seed % 12));
  Vec3d normal{0};  // twice the area vector of the polygon
  for (std::size_t i = 0; i < corners.size(); ++i) {
    normal += glm::cross(Vec3d(corners[i] - corners[0]), Vec3d(corners[(i + 1) % corners.size()] - corners[0]));
  }
  const auto triangles = cut(corners);
  CHECK(triangles.size() == corners.size() - 2);
  double total = 0;
  for (const auto& t : triangles) {
    const Vec3d area = doubled_area(corners, t);
    CHECK(glm::dot(area, normal) > 0);
    total += glm::length(area);
  }
  CHECK(total == Approx(glm::length(normal)).epsilon(1e-5));  // float corners are planar to about 1e-6
}

TEST_CASE("polygon: a convex polygon of many corners is cut in linear time", "[io][polygon]") {
  std::vector<Vec3> corners;
  for (int i = 0; i < 20'000; ++i) {
    const double angle = 2 * glint::pi<double> * i / 20'000;
    corners.push_back({static_cast<float>(1000 * std::cos(angle)), static_cast<float>(1000 * std::sin(angle)), 0});
  }
  CHECK(cut(corners).size() == corners.size() - 2);
}

TEST_CASE("polygon: one without area, or crossing itself, still gives its triangles", "[io][polygon]") {
  const auto corners = GENERATE(std::vector<Vec3>(6, Vec3{1, 2, 3}),                                       //
                                std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}},  //
                                std::vector<Vec3>{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {1, 5, 0}, {1, 1, 0}});
  const auto triangles = cut(corners);
  CHECK(triangles.size() == corners.size() - 2);
  std::set<std::uint32_t> used;
  for (const auto& t : triangles) used.insert(t.begin(), t.end());
  CHECK(used.size() == corners.size());
}

TEST_CASE("polygon: corners in the middle of an edge are kept", "[io][polygon]") {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 1, 0}};
  double total = 0;
  for (const auto& t : cut(corners)) total += doubled_area(corners, t).z;
  CHECK(total == 8);  // twice the area of a 2 x 2 square; integers, so exact
}

}  // namespace test_io_polygon

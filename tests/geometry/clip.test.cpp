// SPDX-License-Identifier: MIT
#include <glint/geometry/clip.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_geometry_clip {

namespace {

using glint::Aabb;
using glint::component;
using glint::max_component;
using glint::Random;
using glint::Vec3;

template <typename T>
using Corners = std::array<Vec3<T>, 3>;

/// The box of a triangle's part in a cell, in long double: corners in the cell, and where edges cross its faces, and
/// where its edges cross the triangle.
class Oracle {
 public:
  using Real = long double;
  using Point = std::array<Real, 3>;

  template <typename T>
  Oracle(const Corners<T>& corners, const Aabb<T>& cell, Real slack) {
    std::vector<Point> polygon;
    for (const auto& c : corners) polygon.push_back({Real(c.x), Real(c.y), Real(c.z)});
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto a = int(axis);
      cut(polygon, axis, Real(component(cell.lower, a)) - slack, 1);
      cut(polygon, axis, Real(component(cell.upper, a)) + slack, -1);
    }
    is_empty = polygon.empty();
    for (const Point& p : polygon) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], p[axis]);
        upper[axis] = std::max(upper[axis], p[axis]);
      }
    }
  }

  Point lower{INFINITY, INFINITY, INFINITY};
  Point upper{-INFINITY, -INFINITY, -INFINITY};
  bool is_empty = true;

 private:
  static void cut(std::vector<Point>& polygon, std::size_t axis, Real plane, Real sign) {
    std::vector<Point> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point& a = polygon[i];
      const Point& b = polygon[(i + 1) % polygon.size()];
      const Real height_a = (a[axis] - plane) * sign;
      const Real height_b = (b[axis] - plane) * sign;
      if (height_a >= 0) kept.push_back(a);
      if ((height_a >= 0) == (height_b >= 0)) continue;
      Point crossing;
      for (std::size_t k = 0; k < 3; ++k) crossing[k] = a[k] + (b[k] - a[k]) * (height_a / (height_a - height_b));
      crossing[axis] = plane;
      kept.push_back(crossing);
    }
    polygon = kept;
  }
};

/// Triangles of all shapes, some thin, some with corners on a grid, near to the origin and far.
template <typename T>
Corners<T> random_triangle(Random& random) {
  const bool on_grid = random.below(4) == 0;
  const T thin = random.below(3) == 0 ? T(1e-4) : T(1);
  const Vec3<T> offset = random.below(3) == 0 ? Vec3<T>(T(1000)) : Vec3<T>(T(0));
  Corners<T> corners;
  for (Vec3<T>& corner : corners) {
    corner = random.uniform_vec3<T>() * T(2) - T(1);
    corner.y *= thin;
    if (on_grid) corner = glm::round(corner * T(2)) / T(2);
    corner += offset;
  }
  return corners;
}

/// Cells that cut a triangle's box anywhere, or hardly.
template <typename T>
Aabb<T> random_cell(Random& random, const Corners<T>& corners) {
  Aabb<T> box;
  for (const Vec3<T>& corner : corners) extend(box, corner);
  const Vec3<T> size = extent(box);
  const Vec3<T> a = box.lower + size * (random.uniform_vec3<T>() * T(1.4) - T(0.2));
  const Vec3<T> b = box.lower + size * (random.uniform_vec3<T>() * T(1.4) - T(0.2));
  Aabb<T> cell{glm::min(a, b), glm::max(a, b)};
  const int axis = int(random.below(3));
  if (random.below(3) == 0) cell.upper[axis] = cell.lower[axis];
  return cell;
}

template <typename T>
T size_of(const Corners<T>& corners) {
  Aabb<T> box;
  for (const Vec3<T>& corner : corners) extend(box, corner);
  return max_component(extent(box)) + max_component(glm::max(abs(box.lower), abs(box.upper))) * T(0.05);
}

}  // namespace

TEMPLATE_TEST_CASE("clip: the box holds the triangle's part in the cell, and hardly more", "[geometry][clip]", float,
                   double) {
  using T = TestType;
  Random random(1);
  std::size_t parts = 0;
  for (int i = 0; i < 20'000; ++i) {
    const Corners<T> corners = random_triangle<T>(random);
    const Aabb<T> cell = random_cell(random, corners);
    const Aabb<T> box = glint::clipped_bounds(corners, cell);
    CAPTURE(i);
    const Oracle exact(corners, cell, 0);
    parts += std::size_t(!exact.is_empty);
    if (!exact.is_empty) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        // but for the oracle's own rounding, of crossings whose coordinates are the cell's
        const auto noise = std::numeric_limits<long double>::epsilon() * 4000;
        REQUIRE(component(box.lower, int(axis)) <= exact.lower[axis] + noise);
        REQUIRE(component(box.upper, int(axis)) >= exact.upper[axis] - noise);
      }
    }
    if (is_empty(box)) continue;
    REQUIRE(contains(cell, box));
    // Nothing is further than the margins, 64 and 4 roundings each way, from the part in the cell grown by as much.
    const auto slack = static_cast<long double>(glint::rounding_bound<T>(400) * size_of(corners));
    const Oracle wide(corners, cell, slack);
    REQUIRE_FALSE(wide.is_empty);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      REQUIRE(component(box.lower, int(axis)) >= wide.lower[axis] - slack);
      REQUIRE(component(box.upper, int(axis)) <= wide.upper[axis] + slack);
    }
  }
  CHECK(parts > 5'000);
}

TEMPLATE_TEST_CASE("clip: every point of the triangle is in one of the boxes of two cells that share a face",
                   "[geometry][clip]", float, double) {
  using T = TestType;
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const Corners<T> corners = random_triangle<T>(random);
    Aabb<T> whole;
    for (const Vec3<T>& corner : corners) extend(whole, corner);
    Aabb<T> below = whole;
    Aabb<T> above = whole;
    const int axis = int(random.below(3));
    below.upper[axis] = above.lower[axis] = random.uniform(whole.lower[axis], whole.upper[axis]);
    const Aabb<T> boxes[]{glint::clipped_bounds(corners, below), glint::clipped_bounds(corners, above)};
    for (int k = 0; k < 100; ++k) {
      T u = random.uniform<T>();
      T v = random.uniform<T>();
      if (u + v > T(1)) {
        u = T(1) - u;
        v = T(1) - v;
      }
      const Vec3<T> rounded = corners[0] + ((corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v);
      const Vec3<T> p = glm::clamp(rounded, whole.lower, whole.upper);  // may round out of the triangle's box
      CAPTURE(i, k);
      REQUIRE((contains(boxes[0], p) || contains(boxes[1], p)));
    }
  }
}

TEST_CASE("clip: the part of a right triangle in a corner of its box is what one computes by hand",
          "[geometry][clip]") {
  const std::array<Vec3<double>, 3> corners{{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}}};
  // x + y ≤ 4 and y ≥ 3 leave x ≤ 1.
  const auto part = glint::clipped_bounds(corners, {{0, 3, -1}, {4, 4, 1}});
  CHECK(part.lower == Vec3<double>{0, 3, 0});
  CHECK(part.upper.x == Approx(1).epsilon(1e-12));
  CHECK(part.upper.y == 4);
  CHECK(is_empty(glint::clipped_bounds(corners, {{3, 3, -1}, {4, 4, 1}})));  // only the box reaches there
  CHECK(is_empty(glint::clipped_bounds(corners, {{5, 5, -1}, {6, 6, 1}})));
  CHECK(glint::clipped_bounds(corners, {{-1, -1, -1}, {9, 9, 9}}) == Aabb<double>{{0, 0, 0}, {4, 4, 0}});
}

TEMPLATE_TEST_CASE("clip: triangles too large for differences keep the overlap of the boxes", "[geometry][clip]", float,
                   double) {
  using T = TestType;
  constexpr T huge = std::numeric_limits<T>::max();
  const std::array<Vec3<T>, 3> corners{Vec3<T>(-huge), {huge, T(0), T(0)}, Vec3<T>(huge)};
  const Aabb<T> cell{Vec3<T>(T(-1)), Vec3<T>(T(1))};
  CHECK(glint::clipped_bounds(corners, cell) == cell);
}

TEMPLATE_TEST_CASE("clip: the tiniest triangles keep all they have", "[geometry][clip]", float, double) {
  using T = TestType;
  constexpr T least = std::numeric_limits<T>::denorm_min();
  const std::array<Vec3<T>, 3> corners{{{T(0), T(0), T(0)}, {least * 9, least, T(0)}, {T(0), least * 9, least}}};
  const Aabb<T> cell{{least * 2, T(0), T(0)}, {least * 9, least * 9, least}};
  const Aabb<T> box = glint::clipped_bounds(corners, cell);
  CHECK(box == cell);  // the margin is far larger than the triangle
}

TEST_CASE("clip: polygons of more corners are cut alike", "[geometry][clip]") {
  const std::array<Vec3<float>, 4> diamond{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}};
  const auto top = glint::clipped_bounds(diamond, {{-1, 0.5F, -1}, {1, 1, 1}});  // |x| + |y| ≤ 1 and y ≥ 1/2
  CHECK(top.lower.x == Approx(-0.5F).epsilon(1e-4));
  CHECK(top.upper.x == Approx(0.5F).epsilon(1e-4));
  CHECK(top.lower.y == 0.5F);
}

}  // namespace test_geometry_clip

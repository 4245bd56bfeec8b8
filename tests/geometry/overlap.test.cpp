// SPDX-License-Identifier: MIT
#include <glint/geometry/overlap.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <glint/geometry/box.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_geometry_overlap {

namespace {

using glint::Aabb;
using glint::Ball;
using glint::Quad;
using glint::Sphere;
using glint::Triangle;
using glint::Vec3;

template <typename T>
Vec3<T> anywhere(glint::Random& random, T reach) {
  return (random.uniform_vec3<T>() * T(2) - T(1)) * reach;
}

template <typename T>
Triangle<T> triangle_at(glint::Random& random, const Vec3<T>& center, T size) {
  const Vec3<T> a = center + anywhere(random, size);
  const Vec3<T> b = center + anywhere(random, size);
  const Vec3<T> c = center + anywhere(random, size);
  return {a, b, c};
}

/// Knows only its box.
struct Lump {
  Vec3<float> center;
};
Aabb<float> bounds(const Lump& lump) {
  return {lump.center - 0.5F, lump.center + 0.5F};
}
std::optional<glint::Hit<float>> intersect(const glint::Ray<float>& /*ray*/, const Lump& /*lump*/) {
  return std::nullopt;
}

}  // namespace

TEMPLATE_TEST_CASE("overlap: parting axes and cutting by the box's faces agree about triangle and box",
                   "[geometry][overlap]", float, double) {
  using T = TestType;
  glint::Random random(2);
  const Aabb<T> box{{T(-0.4), T(-0.7), T(-0.2)}, {T(0.5), T(0.6), T(0.3)}};
  const auto faces = glint::frustum_of(box);
  std::size_t overlapping = 0;
  std::size_t wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto triangle = triangle_at(random, anywhere(random, T(1)), T(1.5));
    const bool by_axes = overlaps(triangle, box);
    wrong += std::size_t(by_axes != overlaps(triangle, faces));
    overlapping += std::size_t(by_axes);
  }
  CHECK(wrong == 0);
  CHECK(overlapping > 5000);
  CHECK(overlapping < 15000);
}

TEMPLATE_TEST_CASE("overlap: a triangle that cuts a corner of the box's box is not in the box", "[geometry][overlap]",
                   float, double) {
  using T = TestType;
  const Aabb<T> unit{{0, 0, 0}, {1, 1, 1}};
  // In the plane x + y + z = s, which leaves the unit cube at s = 3: all three boxes overlap the cube.
  const auto corner_at = [](T s) { return Triangle<T>{{s, 0, 0}, {0, s, 0}, {0, 0, s}}; };
  CHECK(overlaps(corner_at(T(2.9)), unit));
  CHECK(overlaps(corner_at(T(3)), unit));
  CHECK_FALSE(overlaps(corner_at(T(3.1)), unit));
  // An edge in the xy plane past the corner 1 1: x + y = s.
  const auto edge_at = [](T s) { return Triangle<T>{{s, 0, T(0.5)}, {0, s, T(0.5)}, {s, s, T(0.6)}}; };
  CHECK(overlaps(edge_at(T(1.9)), unit));
  CHECK_FALSE(overlaps(edge_at(T(2.1)), unit));
}

TEMPLATE_TEST_CASE("overlap: touching counts, wherever in space it is", "[geometry][overlap]", float, double) {
  using T = TestType;
  glint::Random random(3);
  std::size_t missed = 0;
  for (int i = 0; i < 5000; ++i) {  // a vertex on a face, an edge or a corner
    const Vec3<T> lower = anywhere(random, T(1000));
    const Aabb<T> box{lower, lower + random.uniform_vec3<T>()};
    const Vec3<T> upper = box.upper;
    const std::array<Vec3<T>, 3> touched{upper, Vec3<T>{upper.x, upper.y, lower.z}, Vec3<T>{upper.x, lower.y, upper.z}};
    const Vec3<T> vertex = touched[std::size_t(i % 3)];
    const Vec3<T> away = vertex + random.uniform_vec3<T>();
    missed += std::size_t(!overlaps(Triangle<T>{vertex, away, vertex + random.uniform_vec3<T>()}, box));
  }
  CHECK(missed == 0);
}

TEMPLATE_TEST_CASE("overlap: triangles without area are segments and points, and NaNs are nowhere",
                   "[geometry][overlap]", float, double) {
  using T = TestType;
  const Aabb<T> unit{{0, 0, 0}, {1, 1, 1}};
  CHECK(overlaps(Triangle<T>{{-1, -1, -1}, {2, 2, 2}, {0, 0, 0}}, unit));
  CHECK(overlaps(Triangle<T>{{-1, T(0.5), T(0.5)}, {3, T(0.5), T(0.5)}, {2, T(0.5), T(0.5)}}, unit));
  CHECK_FALSE(overlaps(Triangle<T>{{2, -1, T(0.5)}, {4, 2, T(0.5)}, {3, T(0.5), T(0.5)}}, unit));
  CHECK_FALSE(overlaps(Triangle<T>{{0, T(1.5), 0}, {T(1.5), 0, 0}, {3, T(-1.5), 0}}, Aabb<T>{{1, 1, 0}, {2, 2, 1}}));
  CHECK(overlaps(Triangle<T>{{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}, unit));
  CHECK_FALSE(overlaps(Triangle<T>{{std::numeric_limits<T>::quiet_NaN(), 0, 0}, {1, 0, 0}, {0, 1, 0}}, Ball<T>{}));
  CHECK_FALSE(overlaps(Triangle<T>{{T(0.5), T(0.5), T(0.5)}, {1, 0, 0}, {0, 1, 0}}, Aabb<T>{}));
}

TEMPLATE_TEST_CASE("overlap: a quad is its halves, and a sphere is hollow", "[geometry][overlap]", float, double) {
  using T = TestType;
  const Quad<T> quad{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  CHECK(overlaps(quad, Aabb<T>{{3, 3, -1}, {T(3.5), T(3.5), 1}}));
  CHECK(overlaps(quad, glint::frustum_of(Aabb<T>{{1, T(0.5), -1}, {2, T(0.7), 1}})));
  CHECK_FALSE(overlaps(quad, Aabb<T>{{3, 3, T(0.1)}, {4, 4, 1}}));
  const Sphere<T> sphere{{0, 0, 0}, 2};
  CHECK_FALSE(overlaps(sphere, Aabb<T>{{-1, -1, -1}, {1, 1, 1}}));  // √3 < 2
  CHECK(overlaps(sphere, Aabb<T>{{-1, -1, -1}, {T(1.2), T(1.2), T(1.2)}}));
  CHECK_FALSE(overlaps(sphere, Aabb<T>{{T(1.2), T(1.2), T(1.2)}, {3, 3, 3}}));
  CHECK_FALSE(overlaps(sphere, Ball<T>{{0, 0, 0}, 1}));
  CHECK(overlaps(sphere, Ball<T>{{0, 0, 0}, 2}));
  CHECK(overlaps(sphere, glint::frustum_of(Aabb<T>{{1, -1, -1}, {3, 1, 1}})));
  CHECK_FALSE(overlaps(sphere, glint::frustum_of(Aabb<T>{{T(2.1), -1, -1}, {3, 1, 1}})));
}

TEST_CASE("overlap: a primitive that says nothing is its box", "[geometry][overlap]") {
  const std::vector<Lump> lumps{{{0, 0, 0}}, {{5, 0, 0}}};
  const glint::Elements set{lumps};
  CHECK_FALSE(set.intersect({}, 0));
  CHECK(glint::overlaps(set, 0, Aabb<float>{{0.4F, 0.4F, 0.4F}, {1, 1, 1}}));
  CHECK_FALSE(glint::overlaps(set, 1, Aabb<float>{{0.4F, 0.4F, 0.4F}, {1, 1, 1}}));
  CHECK(glint::overlaps(set, 1, Ball<float>{{4, 0, 0}, 0.5F}));
  CHECK(glint::overlaps(set, 1, glint::frustum_of(Aabb<float>{{4, 0, 0}, {5, 1, 1}})));
  const std::vector<glint::Box<float>> boxes{{{0, 0, 0}, {1, 1, 1}}};  // which is found by its closest point
  CHECK_FALSE(glint::overlaps(glint::Elements{boxes}, 0, Ball<float>{{0.5F, 0.5F, 0.5F}, 0.4F}));
}

}  // namespace test_geometry_overlap

// SPDX-License-Identifier: MIT
#include <glint/geometry/triangle_triangle.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_geometry_triangle_triangle {

namespace {

using glint::Triangle;
using glint::Vec3;

using Whole = std::array<std::int64_t, 3>;
using Corners = std::array<Whole, 3>;

Whole minus(const Whole& a, const Whole& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Whole times(const Whole& a, std::int64_t by) {
  return {a[0] * by, a[1] * by, a[2] * by};
}
Whole cross(const Whole& a, const Whole& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
std::pair<std::int64_t, std::int64_t> extent(const Corners& t, const Whole& axis) {
  const auto at = [&](const Whole& v) { return v[0] * axis[0] + v[1] * axis[1] + v[2] * axis[2]; };
  return std::minmax({at(t[0]), at(t[1]), at(t[2])});
}
Whole normal(const Corners& t) {
  return cross(minus(t[1], t[0]), minus(t[2], t[0]));
}
bool has_area(const Corners& t) {
  return normal(t) != Whole{};
}

/// The oracle, in whole numbers: two triangles are apart where one of these axes parts them: their normals, what is
/// perpendicular to an edge of both, and for those in one plane, to an edge and the normal.
bool meet(const Corners& a, const Corners& b) {
  const auto parts = [&](const Whole& axis) {
    const auto [a_low, a_high] = extent(a, axis);
    const auto [b_low, b_high] = extent(b, axis);
    return a_high < b_low || b_high < a_low;
  };
  if (!has_area(a) || !has_area(b) || parts(normal(a)) || parts(normal(b))) return false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Whole edge_a = minus(a[(i + 1) % 3], a[i]);
    const Whole edge_b = minus(b[(i + 1) % 3], b[i]);
    if (parts(cross(edge_a, normal(a))) || parts(cross(edge_b, normal(b)))) return false;
    for (std::size_t j = 0; j < 3; ++j)
      if (parts(cross(edge_a, minus(b[(j + 1) % 3], b[j])))) return false;
  }
  return true;
}

constexpr std::int64_t fine = 256;

/// The triangle without what is within 1/256 of its first `shared` corners, 256 times as large: two triangles.
std::array<Corners, 2> trimmed(const Corners& t, std::size_t shared) {
  const auto toward = [&](const Whole& from, const Whole& to) {
    const Whole way = minus(to, from);
    return Whole{from[0] * fine + way[0], from[1] * fine + way[1], from[2] * fine + way[2]};
  };
  if (shared == 2) {
    const Corners tip{times(t[2], fine), toward(t[0], t[2]), toward(t[1], t[2])};
    return {tip, tip};
  }
  const Whole near_1 = toward(t[0], t[1]);
  const Whole near_2 = toward(t[0], t[2]);
  return {Corners{times(t[1], fine), times(t[2], fine), near_1}, Corners{near_1, near_2, times(t[2], fine)}};
}

/// Likewise for triangles whose first corners are the same. A common point other than a shared corner goes with one on
/// the edge opposite to it, and one off a shared edge with others farther from it: trimming loses neither.
bool meet_beyond(const Corners& a, const Corners& b, std::size_t shared) {
  if (!has_area(a) || !has_area(b)) return false;
  const Corners whole_a{times(a[0], fine), times(a[1], fine), times(a[2], fine)};
  const Corners whole_b{times(b[0], fine), times(b[1], fine), times(b[2], fine)};
  const auto part_a = trimmed(a, shared);
  const auto part_b = trimmed(b, shared);
  return meet(part_a[0], whole_b) || meet(part_a[1], whole_b) || meet(part_b[0], whole_a) || meet(part_b[1], whole_a);
}

template <typename T>
Triangle<T> triangle_of(const Corners& c, T scale) {
  const auto at = [&](const Whole& v) { return Vec3<T>{T(v[0]), T(v[1]), T(v[2])} * scale; };
  return {at(c[0]), at(c[1]), at(c[2])};
}

/// Corners on a small lattice, so that most of what may be degenerate is.
Corners lattice_triangle(glint::Random& random, std::uint32_t size) {
  Corners t{};
  for (Whole& v : t)
    for (std::int64_t& x : v) x = random.below(size);
  return t;
}

}  // namespace

TEMPLATE_TEST_CASE("triangles: on a lattice they overlap where whole numbers say so", "[geometry][triangle]", float,
                   double) {
  using T = TestType;
  glint::Random random(11);
  std::size_t wrong = 0;
  std::size_t overlapping = 0;
  for (int i = 0; i < 60000; ++i) {
    const auto size = std::uint32_t(3 + i % 4);
    const Corners a = lattice_triangle(random, size);
    const Corners b = lattice_triangle(random, size);
    const bool expected = meet(a, b);
    const Triangle<T> p = triangle_of<T>(a, T(0.1));  // a tenth of a whole number is rounded alike everywhere
    const Triangle<T> q = triangle_of<T>(b, T(0.1));
    const Triangle<T> exact_p = triangle_of<T>(a, T(0.5));
    const Triangle<T> exact_q = triangle_of<T>(b, T(0.5));
    wrong += std::size_t(overlaps(exact_p, exact_q) != expected) +
             std::size_t(overlaps(p, q) != overlaps(Triangle<T>{q.v1, q.v0, q.v2}, p));
    overlapping += std::size_t(expected);
  }
  CHECK(wrong == 0);
  CHECK(overlapping > 10000);
}

TEMPLATE_TEST_CASE("triangles: with corners in common they overlap where they have more in common",
                   "[geometry][triangle]", float, double) {
  using T = TestType;
  glint::Random random(12);
  std::size_t wrong = 0;
  std::array<std::size_t, 4> overlapping{};
  std::array<std::size_t, 4> neighbors{};
  for (int i = 0; i < 60000; ++i) {
    const auto size = std::uint32_t(3 + i % 3);
    const Corners a = lattice_triangle(random, size);
    Corners b = lattice_triangle(random, size);
    const auto shared = std::size_t(1 + i % 2);
    for (std::size_t k = 0; k < shared; ++k) b[k] = a[k];
    if (a[2] == b[2] || (shared == 1 && (a[1] == b[1] || a[1] == b[2] || a[2] == b[1]))) continue;  // more are shared
    const bool expected = meet_beyond(a, b, shared);
    const Triangle<T> p = triangle_of<T>(a, T(0.5));
    const Triangle<T> q = triangle_of<T>(b, T(0.5));
    wrong += std::size_t(overlaps_beyond_corners(p, q) != expected) +
             std::size_t(overlaps_beyond_corners(Triangle<T>{q.v2, q.v0, q.v1}, p) != expected);
    ++(expected ? overlapping : neighbors)[shared];
  }
  CHECK(wrong == 0);
  CHECK(std::min({overlapping[1], overlapping[2], neighbors[1], neighbors[2]}) > 500);
}

TEMPLATE_TEST_CASE("triangles: one that is there twice overlaps itself, and one without area nothing",
                   "[geometry][triangle]", float, double) {
  using T = TestType;
  const Triangle<T> t{{0, 0, 0}, {1, 0, 0}, {0, 1, T(0.3)}};
  CHECK(overlaps(t, t));
  CHECK(overlaps_beyond_corners(t, Triangle<T>{t.v1, t.v2, t.v0}));
  const Triangle<T> needle{{-1, T(0.2), 0}, {1, T(0.2), 0}, {0, T(0.2), 0}};
  CHECK_FALSE(overlaps(t, needle));
  CHECK_FALSE(overlaps(needle, t));
  CHECK_FALSE(overlaps_beyond_corners(needle, t));
  CHECK_FALSE(overlaps(t, Triangle<T>{t.v0, {std::numeric_limits<T>::quiet_NaN(), 0, 0}, t.v2}));
}

}  // namespace test_geometry_triangle_triangle

// SPDX-License-Identifier: MIT
#include <glint/math/orientation.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_math_orientation {

namespace {

using glint::Vec2;
using glint::Vec3;

__extension__ using Integer = __int128;

int sign(Integer x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

/// A whole number of at most `bits` bits, often of few.
double whole(glint::Random& random, std::uint32_t bits) {
  const double x = double(std::int64_t(random.uniform<double>() * double(std::int64_t{1} << random.below(bits + 1))));
  return random.below(2) == 0 ? x : -x;
}

int exact(const Vec2<double>& a, const Vec2<double>& b, const Vec2<double>& c) {
  const auto w = [](double x) { return Integer(x); };
  return sign((w(a.x) - w(c.x)) * (w(b.y) - w(c.y)) - (w(a.y) - w(c.y)) * (w(b.x) - w(c.x)));
}

int exact(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c, const Vec3<double>& d) {
  const auto w = [](double x, double from) { return Integer(x) - Integer(from); };
  const auto minor = [&](double vy, double vz, double wy, double wz) {
    return w(vy, d.y) * w(wz, d.z) - w(vz, d.z) * w(wy, d.y);
  };
  return sign(w(a.x, d.x) * minor(b.y, b.z, c.y, c.z) - w(b.x, d.x) * minor(a.y, a.z, c.y, c.z) +
              w(c.x, d.x) * minor(a.y, a.z, b.y, b.z));
}

}  // namespace

TEST_CASE("orientation: in the plane it is that of whole numbers", "[math][orientation]") {
  glint::Random random(1);
  std::size_t wrong = 0;
  std::size_t on_a_line = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto point = [&] {
      const double x = whole(random, 53);
      return Vec2<double>{x, whole(random, 53)};
    };
    const Vec2<double> a = point();
    Vec2<double> b = point();
    Vec2<double> c = point();
    if (i % 2 == 0) {  // all but on a line
      b = {a.x + 3 * std::floor(c.x / 8), a.y + 3 * std::floor(c.y / 8)};
      c = {a.x + std::floor(c.x / 8), a.y + std::floor(c.y / 8) + double(i % 3)};
    }
    const int sign = glint::orientation(a, b, c);
    wrong += std::size_t(sign != exact(a, b, c)) + std::size_t(sign != -glint::orientation(b, a, c));
    on_a_line += std::size_t(sign == 0);
  }
  CHECK(wrong == 0);
  CHECK(on_a_line > 1000);
}

TEST_CASE("orientation: in space it is that of whole numbers", "[math][orientation]") {
  glint::Random random(2);
  std::size_t wrong = 0;
  std::size_t in_a_plane = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto point = [&](std::uint32_t bits) {
      const double x = whole(random, bits);
      const double y = whole(random, bits);
      return Vec3<double>{x, y, whole(random, bits)};
    };
    const Vec3<double> a = point(36);  // products of three differences are less than 2¹¹⁴
    const Vec3<double> u = point(30);
    const Vec3<double> v = point(30);
    Vec3<double> d = point(36);
    if (i % 2 == 0) d = a + u * double(random.below(50)) - v * double(random.below(50)) + Vec3<double>(0, 0, i % 3);
    const int sign = glint::orientation(a, a + u, a + v, d);
    wrong += std::size_t(sign != exact(a, a + u, a + v, d)) +
             std::size_t(sign != -glint::orientation(a + u, a, a + v, d)) +
             std::size_t(sign != -glint::orientation(d, a + u, a + v, a));
    in_a_plane += std::size_t(sign == 0);
  }
  CHECK(wrong == 0);
  CHECK(in_a_plane > 1000);
}

TEMPLATE_TEST_CASE("orientation: three corners are seen counterclockwise from the side that is below",
                   "[math][orientation]", float, double) {
  using T = TestType;
  const Vec3<T> a{0, 0, 0};
  const Vec3<T> b{1, 0, 0};
  const Vec3<T> c{0, 1, 0};
  CHECK(glint::orientation(a, b, c, Vec3<T>{0, 0, -1}) == 1);  // from above, z > 0, they go around counterclockwise
  CHECK(glint::orientation(a, b, c, Vec3<T>{0, 0, 1}) == -1);
  CHECK(glint::orientation(a, b, c, Vec3<T>{5, 7, 0}) == 0);
  CHECK(glint::orientation(Vec2<T>{0, 0}, Vec2<T>{1, 0}, Vec2<T>{0, 1}) == 1);
  const T tiny = std::numeric_limits<T>::epsilon();
  CHECK(glint::orientation(a, b, c, Vec3<T>{1000, 1000, tiny * tiny}) == -1);
}

}  // namespace test_math_orientation

// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>

#include <glint/core/config.hpp>
#include <glint/math/vec.hpp>

namespace glint {
namespace detail {

/// A sum without rounding, as numbers that do not overlap, the smallest first. For two times twelve products of three.
class ExactSum {
 public:
  void add(double x) noexcept {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i];
      const double shifted = sum - x;
      const double lost = (x - (sum - shifted)) + (parts_[i] - shifted);
      if (lost != 0) parts_[kept++] = lost;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }
  void add_product(double a, double b) noexcept {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  void add_product(double a, double b, double c) noexcept {
    const double product = a * b;
    add_product(std::fma(a, b, -product), c);
    add_product(product, c);
  }
  [[nodiscard]] int sign() const noexcept { return size_ == 0 ? 0 : parts_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, 96> parts_{};
  std::size_t size_ = 0;
};

[[nodiscard]] constexpr int sign_of(double x) noexcept {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

GLINT_NO_INLINE inline int exact_orientation(const Vec2<double>& a, const Vec2<double>& b,
                                             const Vec2<double>& c) noexcept {
  ExactSum sum;
  const auto add_cross = [&](const Vec2<double>& p, const Vec2<double>& q) {
    sum.add_product(p.x, q.y);
    sum.add_product(-p.y, q.x);
  };
  add_cross(a, b);
  add_cross(b, c);
  add_cross(c, a);
  return sum.sign();
}

GLINT_NO_INLINE inline int exact_orientation(const Vec3<double>& a, const Vec3<double>& b, const Vec3<double>& c,
                                             const Vec3<double>& d) noexcept {
  ExactSum sum;
  const auto add_volume = [&](const Vec3<double>& p, const Vec3<double>& q, const Vec3<double>& r) {
    sum.add_product(p.x, q.y, r.z);
    sum.add_product(-p.x, q.z, r.y);
    sum.add_product(p.y, q.z, r.x);
    sum.add_product(-p.y, q.x, r.z);
    sum.add_product(p.z, q.x, r.y);
    sum.add_product(-p.z, q.y, r.x);
  };
  add_volume(a, b, c);
  add_volume(b, a, d);
  add_volume(a, c, d);
  add_volume(c, b, d);
  return sum.sign();
}

}  // namespace detail

/// 1 where a, b, c go around counterclockwise, −1 where they go clockwise, 0 where they are on a line: exactly.
///
/// Errors: of no meaning for a NaN, and where products of two coordinates leave the range of double.
/// Cost:   a few products; where these cannot tell, a microsecond.
/// Source: Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates", Discrete &
///         Computational Geometry 18(3), 1997; here of two stages, the first and the last.
template <std::floating_point T>
[[nodiscard]] int orientation(const Vec2<T>& a, const Vec2<T>& b, const Vec2<T>& c) noexcept {
  const Vec2<double> to_a = Vec2<double>(a) - Vec2<double>(c);
  const Vec2<double> to_b = Vec2<double>(b) - Vec2<double>(c);
  const double left = to_a.x * to_b.y;
  const double right = to_a.y * to_b.x;
  const double area = left - right;
  const double doubt = (std::abs(left) + std::abs(right)) * (2 * std::numeric_limits<double>::epsilon());
  if (std::abs(area) > doubt) return detail::sign_of(area);
  return detail::exact_orientation(Vec2<double>(a), Vec2<double>(b), Vec2<double>(c));
}

/// The sign of the determinant of a − d, b − d and c − d: 1 where d is on the side of a, b, c that sees them clockwise,
/// −1 where it sees them counterclockwise, 0 where all four are in a plane: exactly.
///
/// Errors, Cost, Source: as in the plane, for products of three coordinates.
template <std::floating_point T>
[[nodiscard]] GLINT_ALWAYS_INLINE int orientation(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& c,
                                                  const Vec3<T>& d) noexcept {
  const Vec3<double> at(d);
  const Vec3<double> u = Vec3<double>(a) - at;
  const Vec3<double> v = Vec3<double>(b) - at;
  const Vec3<double> w = Vec3<double>(c) - at;
  const double yz = v.y * w.z;
  const double zy = v.z * w.y;
  const double zx = v.z * w.x;
  const double xz = v.x * w.z;
  const double xy = v.x * w.y;
  const double yx = v.y * w.x;
  const double volume = u.x * (yz - zy) + u.y * (zx - xz) + u.z * (xy - yx);
  const double size = std::abs(u.x) * (std::abs(yz) + std::abs(zy)) + std::abs(u.y) * (std::abs(zx) + std::abs(xz)) +
                      std::abs(u.z) * (std::abs(xy) + std::abs(yx));
  if (std::abs(volume) > size * (4 * std::numeric_limits<double>::epsilon())) return detail::sign_of(volume);
  return detail::exact_orientation(Vec3<double>(a), Vec3<double>(b), Vec3<double>(c), at);
}

}  // namespace glint

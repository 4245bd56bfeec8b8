// SPDX-License-Identifier: MIT
#include <glint/math/frame.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>
#include <glint/math/warp.hpp>

namespace test_math_frame {

using glint::Frame;
using glint::Vec3;

namespace {

template <typename T>
T tolerance() {
  return 8 * std::numeric_limits<T>::epsilon();
}

template <typename T>
void check_orthonormal(const Frame<T>& f) {
  CHECK(std::abs(glm::length(f.x) - 1) < tolerance<T>());
  CHECK(std::abs(glm::length(f.y) - 1) < tolerance<T>());
  CHECK(std::abs(glm::dot(f.x, f.y)) < tolerance<T>());
  CHECK(std::abs(glm::dot(f.x, f.z)) < tolerance<T>());
  CHECK(glm::length(glm::cross(f.x, f.y) - f.z) < 2 * tolerance<T>());  // right-handed
}

}  // namespace

TEMPLATE_TEST_CASE("frame: around any unit vector it is orthonormal and right-handed", "[math][frame]", float, double) {
  glint::Random random{1};
  for (int i = 0; i < 1000; ++i) {
    const Vec3<TestType> z = glm::normalize(glint::uniform_sphere(random.uniform_vec2<TestType>()));
    check_orthonormal(Frame<TestType>::around(z));
  }
  for (const TestType pole : {TestType(1), TestType(-1)}) {
    check_orthonormal(Frame<TestType>::around({0, 0, pole}));
    check_orthonormal(Frame<TestType>::around({TestType(-0.0), 0, pole}));
    check_orthonormal(Frame<TestType>::around({pole, 0, TestType(-0.0)}));
  }
}

TEMPLATE_TEST_CASE("frame: to_world undoes to_local", "[math][frame]", float, double) {
  const auto f = Frame<TestType>::around(glm::normalize(Vec3<TestType>{1, -2, 3}));
  const Vec3<TestType> v{4, 5, -6};
  CHECK(glm::length(f.to_world(f.to_local(v)) - v) < 16 * tolerance<TestType>());
  CHECK(glm::length(f.to_world(Vec3<TestType>{0, 0, 1}) - f.z) == 0);
}

TEMPLATE_TEST_CASE("frame: x follows the tangent as far as the normal lets it", "[math][frame]", float, double) {
  const auto f = Frame<TestType>::from_normal_and_tangent({0, 0, 1}, {3, 0, 7});
  check_orthonormal(f);
  CHECK(f.x == Vec3<TestType>{1, 0, 0});
}

TEMPLATE_TEST_CASE("frame: a tangent without length, or not finite, is replaced by any", "[math][frame]", float,
                   double) {
  const TestType infinite = std::numeric_limits<TestType>::infinity();
  const TestType nan = std::numeric_limits<TestType>::quiet_NaN();
  for (const Vec3<TestType>& tangent :
       {Vec3<TestType>(0), Vec3<TestType>{0, 0, 5}, Vec3<TestType>{infinite, 0, 0}, Vec3<TestType>{0, nan, 0}}) {
    check_orthonormal(Frame<TestType>::from_normal_and_tangent({0, 0, 1}, tangent));
  }
}

}  // namespace test_math_frame

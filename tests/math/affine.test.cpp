// SPDX-License-Identifier: MIT
#include <glint/math/affine.hpp>  // first, so the header proves it stands alone

#include <array>
#include <limits>

#include <support/catch.hpp>

#include <glint/math/random.hpp>

namespace test_math_affine {

namespace {

template <typename T>
bool near(const glint::Vec3<T>& a, const glint::Vec3<T>& b, T roundings = 32) {
  const T scale = T(1) + glint::max_component(glint::abs(b));
  return glint::max_component(glint::abs(a - b)) <= roundings * std::numeric_limits<T>::epsilon() * scale;
}

template <typename T>
glint::Affine<T> random_affine(glint::Random& random) {
  glint::Affine<T> result;
  for (int column = 0; column < 3; ++column) result.linear[column] = random.uniform_vec3<T>() * T(2) - T(1);
  result.translation = random.uniform_vec3<T>() * T(2) - T(1);
  return result;
}

}  // namespace

TEMPLATE_TEST_CASE("affine: reads a matrix row by row, with the translation at 3, 7 and 11", "[math][affine]", float,
                   double) {
  using T = TestType;
  const std::array<T, 16> m{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 0, 0, 0, 1};
  const auto affine = glint::Affine<T>::from_row_major(m);
  REQUIRE(affine);
  CHECK(affine->point({1, 0, 0}) == glint::Vec3<T>(1 + 4, 5 + 8, 9 + 12));
  CHECK(affine->vector({0, 1, 0}) == glint::Vec3<T>(2, 6, 10));
  CHECK(affine->transposed_vector({0, 0, 1}) == glint::Vec3<T>(9, 10, 11));
}

TEMPLATE_TEST_CASE("affine: refuses a matrix that is a projection", "[math][affine]", float, double) {
  std::array<TestType, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  CHECK(glint::Affine<TestType>::from_row_major(m) == glint::Affine<TestType>{});
  for (const auto i : {12U, 13U, 14U, 15U}) {
    auto changed = m;
    changed[i] = TestType(0.5);
    CAPTURE(i);
    CHECK(glint::Affine<TestType>::from_row_major(changed) == std::nullopt);
  }
}

TEMPLATE_TEST_CASE("affine: a product applies its right factor first", "[math][affine]", float, double) {
  using A = glint::Affine<TestType>;
  const auto both = A::translate({1, 0, 0}) * A::scale({2, 3, 4});
  CHECK(both.point({1, 1, 1}) == glint::Vec3<TestType>(3, 3, 4));
  const auto swapped = A::scale({2, 3, 4}) * A::translate({1, 0, 0});
  CHECK(swapped.point({1, 1, 1}) == glint::Vec3<TestType>(4, 3, 4));
}

TEMPLATE_TEST_CASE("affine: a quarter turn about z takes x to y", "[math][affine]", float, double) {
  using T = TestType;
  const auto turn = glint::Affine<T>::rotate({0, 0, 5}, glint::pi<T> / 2);
  CHECK(near<T>(turn.point({1, 0, 0}), {0, 1, 0}));
  CHECK(near<T>(turn.point({0, 1, 0}), {-1, 0, 0}));
  CHECK(near<T>(turn.point({0, 0, 1}), {0, 0, 1}));
}

TEMPLATE_TEST_CASE("affine: a third of a turn about (1, 1, 1) permutes the axes", "[math][affine]", float, double) {
  using T = TestType;
  const auto turn = glint::Affine<T>::rotate({1, 1, 1}, 2 * glint::pi<T> / 3);
  CHECK(near<T>(turn.point({1, 2, 3}), {3, 1, 2}));
}

TEMPLATE_TEST_CASE("affine: look_at puts the target on the camera's −z and up in its yz half plane", "[math][affine]",
                   float, double) {
  using T = TestType;
  const auto camera = glint::Affine<T>::look_at({1, 2, 8}, {1, 2, 3}, {0, 2, 1});
  CHECK(near<T>(camera.point({0, 0, -5}), {1, 2, 3}));
  CHECK(near<T>(camera.vector({1, 0, 0}), {1, 0, 0}));  // looking along −z with y up, the right is +x
  CHECK(near<T>(camera.vector({0, 1, 0}), {0, 1, 0}));
  const auto any_up = glint::Affine<T>::look_at({0, 0, 0}, {0, 3, 0}, {0, 1, 0});
  CHECK(near<T>(any_up.vector({0, 0, -1}), {0, 1, 0}));
  CHECK(glint::is_finite<T>(any_up.vector({1, 1, 1})));
}

TEMPLATE_TEST_CASE("affine: the inverse undoes the map", "[math][affine]", float, double) {
  using T = TestType;
  glint::Random random(7);
  for (int i = 0; i < 200; ++i) {
    const auto affine = random_affine<T>(random);
    const auto back = inverse(affine);
    REQUIRE(back);
    const auto p = random.template uniform_vec3<T>();
    const T condition = glint::max_component(glint::abs(glint::Vec3<T>(back->linear[0]))) +
                        glint::max_component(glint::abs(glint::Vec3<T>(back->linear[1]))) +
                        glint::max_component(glint::abs(glint::Vec3<T>(back->linear[2])));
    CHECK(near(back->point(affine.point(p)), p, T(32) * (T(1) + condition)));
  }
}

TEMPLATE_TEST_CASE("affine: a scale whose determinant would underflow has an inverse all the same", "[math][affine]",
                   float, double) {
  using T = TestType;
  const T tiny = std::ldexp(T(1), std::numeric_limits<T>::min_exponent / 2);  // tiny³ underflows to 0
  const auto back = inverse(glint::Affine<T>::scale(glint::Vec3<T>(tiny)));
  REQUIRE(back);
  CHECK(*back == glint::Affine<T>::scale(glint::Vec3<T>(T(1) / tiny)));
}

TEMPLATE_TEST_CASE("affine: a map that flattens space, or is not finite, has no inverse", "[math][affine]", float,
                   double) {
  using T = TestType;
  using A = glint::Affine<T>;
  CHECK(inverse(A::scale({1, 0, 1})) == std::nullopt);
  CHECK(inverse(A::scale({0, 0, 0})) == std::nullopt);
  CHECK(inverse(A{.linear = {1, 2, 3, 4, 5, 6, 7, 8, 9}}) == std::nullopt);  // 2 · second = first + third
  CHECK(inverse(A{.linear = {T(0.1), T(0.7), T(0.3), T(0.2), T(1.4), T(0.6), 3, 1, 2}}) == std::nullopt);
  CHECK(inverse(A::scale({1, glint::infinity<T>, 1})) == std::nullopt);
  CHECK(inverse(A::scale({1, std::numeric_limits<T>::quiet_NaN(), 1})) == std::nullopt);
  CHECK(inverse(A::translate({glint::infinity<T>, 0, 0})) == std::nullopt);
}

TEMPLATE_TEST_CASE("affine: carried normals stay perpendicular, unit, and on their side", "[math][affine]", float,
                   double) {
  using T = TestType;
  glint::Random random(3);
  for (int i = 0; i < 100; ++i) {
    const auto affine = random_affine<T>(random);
    const auto back = inverse(affine);
    REQUIRE(back);
    const auto normal = glm::normalize(random.template uniform_vec3<T>() * T(2) - T(1));
    const auto frame = glint::Frame<T>::around(normal);
    const auto carried = transform_normal(*back, normal);
    CHECK(std::abs(glm::length(carried) - T(1)) <= 8 * std::numeric_limits<T>::epsilon());
    // n' = L⁻ᵀ n, so n' · L v = n · v / |L⁻ᵀ n|: zero along the surface, positive on the normal's side
    const T rounding = T(256) * std::numeric_limits<T>::epsilon() / std::abs(glm::determinant(affine.linear));
    CHECK(std::abs(glm::dot(carried, affine.vector(frame.x))) <= rounding);
    CHECK(std::abs(glm::dot(carried, affine.vector(frame.y))) <= rounding);
    CHECK(glm::dot(carried, affine.vector(normal)) > T(0));
  }
}

}  // namespace test_math_affine

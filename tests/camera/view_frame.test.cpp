// SPDX-License-Identifier: MIT
#include <glint/camera/view_frame.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_camera_view_frame {

namespace {

using Point = glint::Vec3<float>;

double worst_error(const glint::Frame<double>& frame, const glint::Frame<double>& expected) {
  const auto gap = [](const glint::Vec3<double>& a, const glint::Vec3<double>& b) { return glm::length(a - b); };
  return gap(frame.x, expected.x) + gap(frame.y, expected.y) + gap(frame.z, expected.z);
}

}  // namespace

TEST_CASE("view frame: x is right, y is up, z is backward", "[camera][view_frame]") {
  // Looking along −z with y up, as on a sheet of graph paper.
  CHECK(worst_error(glint::view_frame({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), {}) == 0);
  // Looking along +x: the right hand points to +z.
  CHECK(worst_error(glint::view_frame({0, 0, 0}, {2, 0, 0}, {0, 3, 0}), {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}) == 0);
}

TEST_CASE("view frame: up need not be perpendicular to the view", "[camera][view_frame]") {
  const auto straight = glint::view_frame({0, 0, 5}, {0, 0, 0}, {0, 1, 0});
  CHECK(worst_error(glint::view_frame({0, 0, 5}, {0, 0, 0}, {0, 1, 100}), straight) < 1e-12);
}

TEST_CASE("view frame: an up along the view is replaced by −z, as on a map", "[camera][view_frame]") {
  const glint::Frame<double> map{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};  // seen from above: east right, north (−z) up
  CHECK(worst_error(glint::view_frame({0, 9, 0}, {0, 0, 0}, {0, 1, 0}), map) == 0);
  CHECK(worst_error(glint::view_frame({0, 9, 0}, {0, 0, 0}, {0, -2, 0}), map) == 0);
  CHECK(worst_error(glint::view_frame({0, 9, 0}, {0, 0, 0}, {0, 0, 0}), map) == 0);
  CHECK(worst_error(glint::view_frame({0, 9, 0}, {0, 0, 0}, Point(std::numeric_limits<float>::quiet_NaN())), map) == 0);
}

TEST_CASE("view frame: y is up where neither the given up nor −z will do", "[camera][view_frame]") {
  CHECK(worst_error(glint::view_frame({0, 0, 9}, {0, 0, 0}, {0, 0, 1}), {}) == 0);
}

TEST_CASE("view frame: a target at the eye is looked for along −z", "[camera][view_frame]") {
  CHECK(worst_error(glint::view_frame({1, 2, 3}, {1, 2, 3}, {0, 1, 0}), {}) == 0);
}

TEST_CASE("view frame: is orthonormal and right-handed for oblique and nearly degenerate views", "[camera]") {
  const Point up = GENERATE(Point{0, 1, 0}, Point{1, 2, 3}, Point{0.36F, 0.48F, -0.8F}, Point{1e-20F, 0, 0});
  const Point target = GENERATE(Point{1, 2, 3}, Point{-3, 1e-4F, 0}, Point{1e-30F, 0, 0}, Point{0, -1, 1e-5F},
                                Point{1e30F, 1, -1e30F}, Point{2, 4, 6.00001F});
  CAPTURE(up.x, up.y, up.z, target.x, target.y, target.z);
  const auto f = glint::view_frame({0, 0, 0}, target, up);
  CHECK(glm::dot(f.x, f.x) == Approx(1).epsilon(1e-14));
  CHECK(glm::dot(f.y, f.y) == Approx(1).epsilon(1e-14));
  CHECK(glm::length(glm::cross(f.x, f.y) - f.z) < 1e-9);  // sin of the angle up–view is at least 1e-6: 6 digits lost
}

}  // namespace test_camera_view_frame

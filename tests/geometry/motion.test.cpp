// SPDX-License-Identifier: MIT
#include <glint/geometry/motion.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_geometry_motion {

using glint::Aabb;
using glint::Moment;
using glint::MotionBounds;
using glint::Vec3;

TEMPLATE_TEST_CASE("motion: a moment has the weights of the keys around it, and at a key that key's alone",
                   "[geometry]", float, double) {
  using T = TestType;
  const Moment<T, 3> early(T(0.125));  // a quarter of the way from key 0 to key 1
  CHECK((early.key == 0 && early.before == T(0.75) && early.after == T(0.25)));
  const Moment<T, 3> middle(T(0.5));
  CHECK((middle.key == 1 && middle.before == T(1) && middle.after == T(0)));
  const Moment<T, 3> last(T(1));
  CHECK((last.key == 1 && last.before == T(0) && last.after == T(1)));
  const Vec3<T> a{T(0.1), T(-7), T(3)};
  const Vec3<T> b{T(0.7), T(5), T(-0.3)};
  CHECK(middle.mix(a, b) == a);
  CHECK(last.mix(a, b) == b);
  CHECK(Moment<T, 2>(T(-3)).after == T(0));
  CHECK(Moment<T, 2>(T(7)).after == T(1));
  CHECK(std::isnan(Moment<T, 4>(std::numeric_limits<T>::quiet_NaN()).after));
}

TEMPLATE_TEST_CASE("motion: linear bounds hold what moves between keys, at all times", "[geometry]", float, double) {
  using T = TestType;
  constexpr std::size_t K = 5;
  glint::Random random(11);
  for (int round = 0; round < 50; ++round) {
    std::array<Vec3<T>, K> path;
    std::array<Aabb<T>, K> keys;
    for (std::size_t k = 0; k < K; ++k) {
      path[k] = random.uniform_vec3<T>() * T(10) - T(5);
      extend(keys[k], path[k]);
    }
    const MotionBounds<T> bounds = glint::linear_bounds<T>(keys);
    const Aabb<T> swept = glint::swept_bounds<T>(keys);
    for (int i = 0; i <= 64; ++i) {
      const T time = T(i) / T(64);
      const Moment<T, K> moment(time);
      const Vec3<T> p = moment.mix(path[moment.key], path[moment.key + 1]);
      const Vec3<T> lower = bounds.begin.lower * (T(1) - time) + bounds.end.lower * time;
      const Vec3<T> upper = bounds.begin.upper * (T(1) - time) + bounds.end.upper * time;
      CHECK(contains(Aabb<T>{lower, upper}, p));
      CHECK(contains(swept, p));
    }
  }
}

TEST_CASE("motion: of two keys, linear bounds are their boxes; of one that is not bounded, nothing", "[geometry]") {
  const std::array<Aabb<float>, 2> keys{{{{0, 0, 0}, {1, 1, 1}}, {{5, 0, 0}, {6, 2, 1}}}};
  CHECK(glint::linear_bounds<float>(keys) == MotionBounds<float>{keys[0], keys[1]});
  const std::array<Aabb<float>, 2> lost{{{{0, 0, 0}, {1, 1, 1}}, {}}};
  CHECK(is_empty(glint::linear_bounds<float>(lost).begin));
  CHECK(is_empty(glint::swept_bounds<float>(lost)));
}

}  // namespace test_geometry_motion

// SPDX-License-Identifier: MIT
#include <glint/geometry/aabb.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_geometry_aabb {

using glint::Aabb;
using glint::Vec3;

TEMPLATE_TEST_CASE("aabb: the default is empty and neutral in unions", "[geometry][aabb]", float, double) {
  const Aabb<TestType> box{{0, 1, 2}, {3, 4, 5}};
  CHECK(is_empty(Aabb<TestType>{}));
  CHECK(join(Aabb<TestType>{}, box) == box);
  CHECK(join(box, Aabb<TestType>{}) == box);
  CHECK(half_area(Aabb<TestType>{}) == 0);
  CHECK_FALSE(contains(Aabb<TestType>{}, Vec3<TestType>(0)));
}

TEMPLATE_TEST_CASE("aabb: faces belong to the box, and a box of one point is not empty", "[geometry][aabb]", float,
                   double) {
  Aabb<TestType> box;
  extend(box, Vec3<TestType>{1, 2, 3});
  CHECK_FALSE(is_empty(box));
  CHECK(contains(box, Vec3<TestType>{1, 2, 3}));
  CHECK(half_area(box) == 0);
  extend(box, Vec3<TestType>{-1, 5, 3});
  CHECK(box == Aabb<TestType>{{-1, 2, 3}, {1, 5, 3}});
  CHECK(contains(box, Vec3<TestType>{0, 5, 3}));
  CHECK_FALSE(contains(box, Vec3<TestType>{0, 5, 3.5}));
}

TEMPLATE_TEST_CASE("aabb: a NaN coordinate leaves its axis unchanged", "[geometry][aabb]", float, double) {
  Aabb<TestType> box{{0, 0, 0}, {1, 1, 1}};
  extend(box, Vec3<TestType>{2, std::numeric_limits<TestType>::quiet_NaN(), -1});
  CHECK(box == Aabb<TestType>{{0, 0, -1}, {2, 1, 1}});
}

TEMPLATE_TEST_CASE("aabb: a box with a NaN face is empty", "[geometry][aabb]", float, double) {
  CHECK(is_empty(Aabb<TestType>{{0, std::numeric_limits<TestType>::quiet_NaN(), 0}, {1, 1, 1}}));
}

TEMPLATE_TEST_CASE("aabb: area, extent and centroid of a brick", "[geometry][aabb]", float, double) {
  const Aabb<TestType> box{{1, 1, 1}, {2, 3, 4}};
  CHECK(extent(box) == Vec3<TestType>{1, 2, 3});
  CHECK(half_area(box) == 11);  // 1·2 + 2·3 + 3·1
  CHECK(centroid(box) == Vec3<TestType>{1.5, 2, 2.5});
}

TEMPLATE_TEST_CASE("aabb: a box near the largest number has a centroid", "[geometry][aabb]", float, double) {
  const TestType huge = std::numeric_limits<TestType>::max();
  CHECK(glint::is_finite(centroid(Aabb<TestType>{Vec3<TestType>(huge), Vec3<TestType>(huge)})));
}

TEMPLATE_TEST_CASE("aabb: overlap is what both hold", "[geometry][aabb]", float, double) {
  const Aabb<TestType> a{{0, 0, 0}, {2, 2, 2}};
  CHECK(overlap(a, Aabb<TestType>{{1, 1, 1}, {3, 3, 3}}) == Aabb<TestType>{{1, 1, 1}, {2, 2, 2}});
  CHECK(is_empty(overlap(a, Aabb<TestType>{{3, 0, 0}, {4, 2, 2}})));
  CHECK_FALSE(is_empty(overlap(a, Aabb<TestType>{{2, 0, 0}, {4, 2, 2}})));  // they touch
}

TEMPLATE_TEST_CASE("aabb: a box holds its parts, itself, and the empty one", "[geometry][aabb]", float, double) {
  const Aabb<TestType> box{{0, 0, 0}, {2, 2, 2}};
  CHECK(contains(box, box));
  CHECK(contains(box, Aabb<TestType>{{0, 1, 0}, {1, 2, 2}}));
  CHECK(contains(box, Aabb<TestType>{}));
  CHECK_FALSE(contains(box, Aabb<TestType>{{0, 1, 0}, {1, 2.5, 2}}));
}

TEMPLATE_TEST_CASE("aabb: a bounded box is neither empty nor infinite", "[geometry][aabb]", float, double) {
  constexpr TestType inf = std::numeric_limits<TestType>::infinity();
  constexpr TestType nan = std::numeric_limits<TestType>::quiet_NaN();
  CHECK(is_bounded(Aabb<TestType>{{0, 1, 2}, {3, 4, 5}}));
  CHECK(is_bounded(Aabb<TestType>{{0, 0, 0}, {0, 0, 0}}));
  CHECK_FALSE(is_bounded(Aabb<TestType>{}));
  CHECK_FALSE(is_bounded(Aabb<TestType>{{0, 0, 0}, {1, inf, 1}}));
  CHECK_FALSE(is_bounded(Aabb<TestType>{{-inf, 0, 0}, {1, 1, 1}}));
  CHECK_FALSE(is_bounded(Aabb<TestType>{{0, 0, nan}, {1, 1, 1}}));
  CHECK_FALSE(is_bounded(Aabb<TestType>{{0, 2, 0}, {1, 1, 1}}));
}

}  // namespace test_geometry_aabb

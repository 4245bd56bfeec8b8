// SPDX-License-Identifier: MIT
#include <glint/bvh/query/region.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cstddef>
#include <limits>

#include <glint/math/random.hpp>

#include <support/catch.hpp>

namespace test_bvh_query_region {

namespace {

using glint::Aabb;
using glint::Vec3;

/// A ball of the user's, of which trees know no more than that.
template <typename T>
struct OwnBall {
  glint::Ball<T> ball;
};
template <typename T>
bool overlaps(const Aabb<T>& box, const OwnBall<T>& own) {
  return overlaps(box, own.ball);
}
template <typename T>
bool contains(const OwnBall<T>& own, const Aabb<T>& box) {
  return contains(own.ball, box);
}

template <typename T, int N>
glint::BoxPack<T, N> pack_of(const std::array<Aabb<T>, std::size_t(N)>& boxes) {
  glint::BoxPack<T, N> pack;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = [&](int lane) -> const Aabb<T>& { return boxes[std::size_t(lane)]; };
    pack.planes[std::size_t(axis)] =
        glint::Pack<T, N>::generate([&](int lane) { return glint::component(at(lane).lower, axis); });
    pack.planes[std::size_t(axis) + 3] =
        glint::Pack<T, N>::generate([&](int lane) { return glint::component(at(lane).upper, axis); });
  }
  return pack;
}

/// Boxes of which eight at once say less than one by one: what overlaps must be entered, and only what is contained
/// may be taken whole.
template <typename T, typename Region>
std::size_t disagreements(const Region& region) {
  glint::Random random(5);
  const glint::RegionQuery<Region, T, 8> query(region);
  std::size_t wrong = 0;
  std::size_t outside = 0;
  std::size_t within = 0;
  for (int i = 0; i < 500; ++i) {
    std::array<Aabb<T>, 8> boxes;
    for (Aabb<T>& box : boxes) {
      const Vec3<T> lower = random.uniform_vec3<T>() * T(4) - T(2);
      box = {lower, lower + random.uniform_vec3<T>()};
    }
    const glint::RegionEntered entered = query.enter(pack_of<T, 8>(boxes));
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const bool may = (entered.overlapping >> lane & 1U) != 0;
      const bool whole = (entered.within >> lane & 1U) != 0;
      wrong += std::size_t(may != overlaps(boxes[lane], region)) + std::size_t(whole != contains(region, boxes[lane]));
      outside += std::size_t(!may);
      within += std::size_t(whole);
    }
  }
  return wrong + std::size_t(outside < 100) + std::size_t(within < 20);
}

}  // namespace

TEMPLATE_TEST_CASE("region query: eight boxes at once are what they are one by one", "[bvh][query][region]", float,
                   double) {
  using T = TestType;
  CHECK(disagreements<T>(Aabb<T>{{T(-1), T(-1.1), T(-1.2)}, {1, T(1.1), T(1.2)}}) == 0);
  CHECK(disagreements<T>(glint::Ball<T>{{T(0.1), 0, 0}, T(1.6)}) == 0);
  CHECK(disagreements<T>(OwnBall<T>{{{T(0.1), 0, 0}, T(1.6)}}) == 0);
  const auto turned = glint::Affine<T>::rotate({1, 2, 3}, T(0.5));
  const auto frustum = glint::frustum_of(Aabb<T>{{T(-1), T(-1), T(-1)}, {T(1.2), 1, 1}});
  CHECK(disagreements<T>(transform_by_inverse(turned, frustum)) == 0);
}

TEMPLATE_TEST_CASE("region query: missing boxes are not boxes, and NaNs may overlap", "[bvh][query][region]", float,
                   double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN();
  const auto pack = pack_of<T, 4>({Aabb<T>{}, Aabb<T>{{0, 0, 0}, {1, 1, 1}}, Aabb<T>{Vec3<T>(nan), Vec3<T>(nan)}});
  CHECK(glint::lanes_of_boxes(pack) == 2);
  const auto entered = glint::RegionQuery<Aabb<T>, T, 4>(Aabb<T>{{T(-1), T(-1), T(-1)}, {2, 2, 2}}).enter(pack);
  CHECK((entered.overlapping & 6U) == 6);
  CHECK((entered.within & 6U) == 2);
}

}  // namespace test_bvh_query_region

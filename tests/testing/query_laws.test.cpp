// SPDX-License-Identifier: MIT
#include <glint/testing/query_laws.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/query/nearest.hpp>
#include <glint/bvh/query/ray.hpp>

namespace test_testing_query_laws {

namespace {

using glint::Aabb;
using glint::Ray;
using glint::testing::violations_of_query_laws;

template <typename T>
constexpr Aabb<T> region{{-1, -1, -1}, {1, 1, 1}};

}  // namespace

TEMPLATE_TEST_CASE("query laws: hold for rays and points", "[testing][query_laws]", float, double) {
  using T = TestType;
  const Ray<T> ray{.origin = {-2, T(0.1), T(-0.2)}, .direction = {1, T(0.1), T(0.2)}, .t_max = T(2.5)};
  const auto reach = glint::RayReach<T>::of(region<T>);
  const glint::RayQuery<T, 4, glint::RayOrder::NearestFirst> nearest(ray, reach);
  CHECK(violations_of_query_laws<4>(nearest, region<T>, 1) == std::vector<std::string>{});
  const glint::RayQuery<T, 8, glint::RayOrder::Any> any(ray, reach);
  CHECK(violations_of_query_laws<8>(any, region<T>, 2) == std::vector<std::string>{});
  const glint::PointQuery<T, 8> point({T(0.3), T(0.5), T(-2)}, T(2));
  CHECK(violations_of_query_laws<8>(point, region<T>, 3) == std::vector<std::string>{});
}

namespace {

/// Boxes near the origin, judged by their middles: a large box can be farther than a small one in it.
struct ByMiddle {
  static constexpr bool ordered = true;

  [[nodiscard]] static glint::Entered<float, 4> enter(const glint::BoxPack<float, 4>& boxes) {
    const auto x = (boxes.planes[0] + boxes.planes[3]) * glint::Pack<float, 4>::broadcast(0.5F);
    const auto distance = max(x, glint::Pack<float, 4>::broadcast(0) - x);
    return {less_equal(distance, glint::Pack<float, 4>::broadcast(limit())), distance};
  }
  [[nodiscard]] static float limit() { return 0.3F; }
};

}  // namespace

TEST_CASE("query laws: find a query that would lose leaves, and one whose keys mislead", "[testing][query_laws]") {
  const auto broken = violations_of_query_laws<4>(ByMiddle{}, region<float>, 4);
  REQUIRE(broken.size() == 2);
  CHECK(broken[0].find("a box that holds one that matters matters") == 0);
  CHECK(broken[1].find("a box that holds another has no larger key") == 0);
}

}  // namespace test_testing_query_laws

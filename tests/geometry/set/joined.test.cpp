// SPDX-License-Identifier: MIT
#include <glint/geometry/set/joined.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <vector>

#include <glint/geometry/elements.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>

#include <support/catch.hpp>
#include <support/closed_meshes.hpp>

namespace test_geometry_set_joined {

namespace {

template <typename T>
using Example = glint::Joined<glint::TriangleMesh<T>, glint::Elements<glint::Sphere<T>>, glint::TriangleMesh<T>>;

static_assert(glint::PreparedSet<Example<float>> && glint::ShadableSet<Example<double>>);

}  // namespace

TEMPLATE_TEST_CASE("joined: indices run through the sets in order", "[geometry][joined]", float, double) {
  using T = TestType;
  const auto four = glint::testing::tetrahedron<T>();
  const auto eight = glint::testing::octahedron<T>();
  const std::vector<glint::Sphere<T>> spheres(3);
  const std::vector<glint::Sphere<T>> no_spheres;
  const glint::Joined set{view(four), glint::Elements{spheres}, glint::Elements{no_spheres}, view(eight)};
  REQUIRE(set.size() == 15);
  using Place = typename decltype(set)::Place;
  CHECK(set.locate(0) == Place{0, 0});
  CHECK(set.locate(3) == Place{0, 3});
  CHECK(set.locate(4) == Place{1, 0});
  CHECK(set.locate(6) == Place{1, 2});
  CHECK(set.locate(7) == Place{3, 0});  // the empty set holds no index
  CHECK(set.locate(14) == Place{3, 7});
  CHECK(set.bounds(14) == view(eight).bounds(7));
  CHECK(set.template set<1>().size() == 3);
}

TEMPLATE_TEST_CASE("joined: hits and surfaces are those of the sets, with indices of the whole", "[geometry][joined]",
                   float, double) {
  using T = TestType;
  const auto four = glint::testing::tetrahedron<T>();
  const auto eight = glint::testing::octahedron<T>();
  const std::vector<glint::Sphere<T>> spheres{{.radius = T(1)}, {.radius = T(2)}};
  const auto first = view(four);
  const glint::Elements second{spheres};
  const auto third = view(eight);
  const glint::Joined set{first, second, third};
  const glint::Ray<T> ray{{T(0.1), T(0.2), T(4)}, {T(0), T(0), T(-1)}};
  const auto prepared = set.prepare(ray);
  int hits = 0;
  for (std::uint32_t i = 0; i < set.size(); ++i) {
    const auto [number, local] = set.locate(i);
    auto expected = number == 0   ? first.intersect(ray, local)
                    : number == 1 ? second.intersect(ray, local)
                                  : third.intersect(ray, local);
    const auto hit = set.intersect(ray, i);
    CHECK(hit == set.intersect(ray, prepared, i));
    REQUIRE(hit.has_value() == expected.has_value());
    if (!hit) continue;
    ++hits;
    const auto at = number == 0   ? first.surface(ray, *expected)
                    : number == 1 ? second.surface(ray, *expected)
                                  : third.surface(ray, *expected);
    CHECK(set.surface(ray, *hit) == at);
    expected->primitive = i;
    CHECK(*hit == *expected);
  }
  CHECK(hits >= 6);  // two faces of each mesh, both spheres
}

TEMPLATE_TEST_CASE("joined: a joined set can be joined again", "[geometry][joined]", float, double) {
  using T = TestType;
  const auto four = glint::testing::tetrahedron<T>();
  const std::vector<glint::Sphere<T>> spheres(1);
  const glint::Joined inner{view(four), glint::Elements{spheres}};
  const glint::Joined alone{glint::Joined{inner, view(four)}, glint::Elements{spheres}};
  REQUIRE(alone.size() == 10);
  const glint::Ray<T> ray{{T(0.1), T(0.2), T(4)}, {T(0), T(0), T(-1)}};
  const auto hit = alone.intersect(ray, alone.prepare(ray), 9);
  REQUIRE(hit);
  CHECK(hit->primitive == 9);
  CHECK(hit->t == inner.intersect(ray, 4)->t);
}

TEMPLATE_TEST_CASE("joined: clips what its sets can, and cuts the boxes of the others", "[geometry][joined]", float,
                   double) {
  using T = TestType;
  const auto four = glint::testing::tetrahedron<T>();
  const std::vector<glint::Sphere<T>> spheres(1);
  const glint::Joined set{glint::Elements{spheres}, view(four)};
  STATIC_REQUIRE(glint::ClippableSet<decltype(set)>);
  STATIC_REQUIRE_FALSE(glint::ClippableSet<glint::Joined<glint::Elements<glint::Sphere<T>>>>);
  const glint::Aabb<T> cell{glint::Vec3<T>(T(-0.5)), glint::Vec3<T>(T(2))};
  CHECK(set.clip(0, cell) == overlap(set.bounds(0), cell));
  CHECK(set.clip(1, cell) == view(four).clip(0, cell));
}

}  // namespace test_geometry_set_joined

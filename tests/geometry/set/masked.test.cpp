// SPDX-License-Identifier: MIT
#include <glint/geometry/set/masked.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <span>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/catch.hpp>

namespace test_geometry_set_masked {

using glint::Affine;
using glint::Bvh;
using glint::Instance;
using glint::Instanced;
using glint::Masked;
using glint::Ray;

TEMPLATE_TEST_CASE("masked: a ray meets a primitive where their bits meet, and with no mask of its own all",
                   "[geometry]", float, double) {
  using T = TestType;
  const auto equal = glint::testing::identical_triangles<T>(3);
  const std::vector<std::uint32_t> masks{0b01, 0b10, 0};
  const Masked set{view(equal), masks};
  static_assert(glint::PreparedSet<decltype(set)> && glint::ShadableSet<decltype(set)>);
  static_assert(glint::ClippableSet<decltype(set)> && glint::ClosestPointSet<decltype(set)>);
  const auto meets = [&](std::uint32_t ray_mask, std::uint32_t i) {
    const Ray<T> ray{.origin = {0, 0, 3}, .mask = ray_mask};
    const auto hit = set.intersect(ray, i);
    CHECK(set.intersect(ray, set.prepare(ray), i) == hit);
    if (hit) CHECK(hit == view(equal).intersect(ray, i));
    return hit.has_value();
  };
  CHECK(meets(0b01, 0));
  CHECK(meets(0b11, 0));
  CHECK_FALSE(meets(0b10, 0));
  CHECK_FALSE(meets(0b01, 1));
  CHECK(meets(Ray<T>{}.mask, 1));
  CHECK_FALSE(meets(Ray<T>{}.mask, 2));
  CHECK_FALSE(meets(0, 0));
}

TEST_CASE("masked: what throws no shadow is seen, and is not in the way of light", "[geometry]") {
  const auto equal = glint::testing::identical_triangles<float>(2);
  const Bvh<glint::TriangleMesh<float>> object(view(equal));
  const std::vector<Instance<Bvh<glint::TriangleMesh<float>>>> stand{place(object, Affine<float>::translate({0, 0, 1})),
                                                                     place(object, Affine<float>{})};
  // <region: mask>
  constexpr std::uint32_t seen = 1;
  constexpr std::uint32_t throws_shadow = 2;
  const std::vector<std::uint32_t> masks{seen, seen | throws_shadow};  // one an instance
  const Bvh world{Masked{Instanced{stand}, masks}};

  const auto hit = world.closest({.origin = {0, 0, 3}, .mask = seen});
  const bool is_dark = world.occluded({.origin = {0, 0, 3}, .t_max = 2.5F, .mask = throws_shadow});
  // </region: mask>
  REQUIRE(hit);
  CHECK(hit->primitive == 0);
  CHECK_FALSE(is_dark);  // the instance at z = 1 is passed, and the other is three away
  CHECK(world.occluded({.origin = {0, 0, 3}, .mask = throws_shadow}));
}

TEST_CASE("masked: masks may be members of the user's structs", "[geometry]") {
  struct Thing {
    float weight;
    std::uint32_t mask;
  };
  const auto equal = glint::testing::identical_triangles<float>(2);
  const std::vector<Thing> things{{0.5F, 4}, {1.5F, 8}};
  const Masked set{view(equal), glint::strided_member(std::span(things), &Thing::mask)};
  CHECK(set.mask(0) == 4);
  CHECK(set.mask(1) == 8);
}

TEST_CASE("masked: the mask of a ray goes with it into instances, at each level", "[geometry]") {
  const auto equal = glint::testing::identical_triangles<float>(2);
  const std::vector<std::uint32_t> inner{0b0001, 0b0010};
  const Bvh object{Masked{view(equal), inner}};
  const std::vector<Instance<std::remove_const_t<decltype(object)>>> stand{
      place(object, Affine<float>{}), place(object, Affine<float>::translate({0, 0, -1}))};
  const std::vector<std::uint32_t> outer{0b0100, 0b1000};
  const Bvh world{Masked{Instanced{stand}, outer}};
  static_assert(glint::OccluderSet<Masked<Instanced<std::remove_const_t<decltype(object)>>>>);
  const auto seen = [&](std::uint32_t mask) {
    const Ray<float> ray{.origin = {0, 0, 3}, .mask = mask};
    const auto hit = world.closest(ray);
    CHECK(world.occluded(ray) == hit.has_value());
    return hit ? world.set().set().path(*hit) : std::vector<std::uint32_t>{};
  };
  // An instance is seen by its bit, then a triangle in it by its own.
  CHECK(seen(0b0101) == std::vector<std::uint32_t>{0, 0});
  CHECK(seen(0b0110) == std::vector<std::uint32_t>{0, 1});
  CHECK(seen(0b1001) == std::vector<std::uint32_t>{1, 0});
  CHECK(seen(0b1010) == std::vector<std::uint32_t>{1, 1});
  CHECK(seen(0b1100).empty());
  CHECK(seen(0b0011).empty());
}

}  // namespace test_geometry_set_masked

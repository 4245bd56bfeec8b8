// SPDX-License-Identifier: MIT
#include <glint/geometry/set/instanced.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>

namespace test_geometry_set_instanced {

namespace {

using glint::Affine;
using glint::BruteForce;
using glint::Bvh;
using glint::Hit;
using glint::Instance;
using glint::Instanced;
using glint::MeshBuffers;
using glint::Ray;
using glint::TriangleMesh;
using glint::Vec3;

template <typename T>
using Tree = Bvh<TriangleMesh<T>>;

/// Turned, squeezed along one axis, and every second one mirrored.
template <typename T>
Affine<T> placement(std::size_t i) {
  const T x = T(i);
  const Vec3<T> factors{i % 2 == 0 ? T(0.5) : T(-0.5), T(1.5), T(0.25) + T(0.1) * x};
  return Affine<T>::translate({x - T(2), T(0.3) * x, T(-0.2) * x}) * Affine<T>::rotate({T(1), x, T(2)}, T(0.7) * x) *
         Affine<T>::scale(factors);
}

template <typename T>
struct Copies {
  MeshBuffers<T> mesh;
  std::vector<std::vector<std::uint32_t>> paths;  ///< of each triangle

  void add(const MeshBuffers<T>& object, const Affine<T>& to_world, const std::vector<std::uint32_t>& prefix) {
    const auto first = std::uint32_t(mesh.positions.size());
    for (const Vec3<T>& p : object.positions) mesh.positions.push_back(to_world.point(p));
    for (const std::uint32_t i : object.indices) mesh.indices.push_back(first + i);
    for (std::uint32_t i = 0; i < object.indices.size() / 3; ++i) {
      paths.push_back(prefix);
      paths.back().push_back(i);
    }
  }
};

/// Checks hits against those at triangles that were moved one by one. Rays that may pass an edge on either side, or
/// meet two triangles at once, are too rare to occur among those of a seed.
template <typename T, typename Caster>
void check_against_copies(const Caster& caster, const Copies<T>& copies) {
  const BruteForce oracle(view(copies.mesh));
  glint::Random random(5);
  std::size_t found = 0;
  for (int i = 0; i < 900; ++i) {
    const auto point = [&](T grown) {
      const auto box = oracle.bounds();
      return (box.lower + box.upper) * T(0.5) + extent(box) * (random.uniform_vec3<T>() - T(0.5)) * grown;
    };
    const Vec3<T> from = point(T(2));
    const Ray<T> ray{.origin = from, .direction = point(T(0.6)) - from};
    const auto hit = caster.closest(ray);
    const auto expected = oracle.closest(ray);
    CAPTURE(i);
    REQUIRE(hit.has_value() == expected.has_value());
    CHECK(caster.occluded(ray) == hit.has_value());
    if (!hit) continue;
    ++found;
    CHECK(caster.set().path(*hit) == copies.paths[expected->primitive]);
    CHECK(std::abs(hit->t - expected->t) <= T(1e4) * glint::rounding_bound<T>(1));
    // Points are where the moved triangle is, within the bounds that both give; normals say the same side, but for
    // mirror images, whose triangles turn the other way.
    const auto s = caster.surface(ray, *hit);
    const auto e = oracle.surface(ray, *expected);
    const Vec3<T> apart = abs(s.position - e.position);
    const T rounding = T(1e4) * glint::rounding_bound<T>(1);
    CHECK(glint::max_component(apart) <= rounding);
    CHECK(std::abs(std::abs(dot(s.normal, e.normal)) - T(1)) <= T(1e4) * glint::rounding_bound<T>(1));
    CHECK(glint::max_component(s.position_error) > T(0));
  }
  CHECK(found > 40);  // enough of them meet something
}

}  // namespace

TEMPLATE_TEST_CASE("instanced: rays find what they find among copies that were moved", "[geometry]", float, double) {
  using T = TestType;
  const auto soup = glint::testing::triangle_soup<T>(60, 1);
  const Tree<T> object(view(soup));
  std::vector<Instance<Tree<T>>> instances;
  Copies<T> copies;
  for (std::uint32_t i = 0; i < 5; ++i) {
    instances.push_back(place(object, placement<T>(i)));
    copies.add(soup, placement<T>(i), {i});
  }
  const Bvh world{Instanced{instances}};
  check_against_copies(world, copies);
  CHECK(glint::testing::violations_of_ray_caster_laws(world, BruteForce{Instanced{instances}}, 3) ==
        std::vector<std::string>{});
}

TEMPLATE_TEST_CASE("instanced: three levels have hits that say the whole path", "[geometry]", float, double) {
  using T = TestType;
  const auto few = glint::testing::triangle_soup<T>(9, 2);
  const auto many = glint::testing::triangle_soup<T>(31, 3);
  const Tree<T> objects[] = {Tree<T>(view(few)), Tree<T>(view(many))};
  std::vector<Instance<Tree<T>>> low{place(objects[0], placement<T>(1)), place(objects[1], placement<T>(2)),
                                     place(objects[0], placement<T>(3))};
  using Group = Bvh<Instanced<Tree<T>>>;
  const Group group(Instanced{low});
  std::vector<Instance<Group>> high;
  Copies<T> copies;
  for (std::uint32_t i = 0; i < 4; ++i) {
    high.push_back(place(group, placement<T>(i + 2)));
    for (std::uint32_t j = 0; j < 3; ++j)
      copies.add(j == 1 ? many : few, placement<T>(i + 2) * placement<T>(j + 1), {0, i, j});
  }
  using Groups = Bvh<Instanced<Group>>;
  const Groups groups(Instanced{high});
  const std::vector<Instance<Groups>> top{place(groups, Affine<T>{})};
  check_against_copies(Bvh{Instanced{top}}, copies);
}

TEST_CASE("instanced: t counts multiples of the world's direction, whatever the scale", "[geometry]") {
  const auto cube = glint::testing::closed_cube<float>();
  const Tree<float> object(view(cube));
  const std::vector<Instance<Tree<float>>> instances{
      place(object, Affine<float>::translate({0, 0, -10}) * Affine<float>::scale({4, 4, 4}))};
  // The cube reaches from z = −14 to −6, and the direction is two long.
  const Ray<float> ray{.origin = {0.5F, 0.25F, 0}, .direction = {0, 0, -2}};
  const auto hit = Instanced{instances}.intersect(ray, 0);
  REQUIRE(hit);
  CHECK(hit->t == Approx(3));
  CHECK(Instanced{instances}.occluded(ray, 0));
  CHECK(Bvh{Instanced{instances}}.surface(ray, *hit).normal == Vec3<float>{0, 0, 1});
  CHECK(instances[0].bounds.lower.z <= -14);
  CHECK(instances[0].bounds.lower.z > -14.001F);
}

TEST_CASE("instanced: of instances at one place, the first is hit", "[geometry]") {
  const auto equal = glint::testing::identical_triangles<float>(3);
  const Tree<float> object(view(equal));
  const std::vector<Instance<Tree<float>>> instances(20, place(object, Affine<float>{}));
  const auto hit = Bvh{Instanced{instances}}.closest({.origin = {0, 0, 3}});
  REQUIRE(hit);
  CHECK(hit->primitive == 0);
  CHECK(hit->inner == 0);
}

TEST_CASE("instanced: a map that flattens space is never hit, and left out of trees", "[geometry]") {
  const auto cube = glint::testing::closed_cube<float>();
  const Tree<float> object(view(cube));
  const std::vector<Instance<Tree<float>>> instances{place(object, Affine<float>::scale({1, 1, 0}))};
  const Bvh world{Instanced{instances}};
  CHECK(world.statistics().left_out == 1);
  const Ray<float> ray{.origin = {0.1F, 0.2F, 3}};
  CHECK_FALSE(world.closest(ray));
  CHECK_FALSE(Instanced{instances}.intersect(ray, 0));
  CHECK_FALSE(Instanced{instances}.occluded(ray, 0));
}

TEST_CASE("instanced: objects may mix instances with other primitives, behind a filter", "[geometry]") {
  const auto cube = glint::testing::closed_cube<float>();
  const Tree<float> object(view(cube));
  const std::vector<Instance<Tree<float>>> low{place(object, Affine<float>::translate({4, 0, 0}))};
  const auto all = [](const auto& /*ray*/, const auto& /*hit*/) { return true; };
  const Bvh mixed{glint::Filtered{glint::Joined{Instanced{low}, view(cube)}, all}};
  const std::vector<Instance<std::remove_const_t<decltype(mixed)>>> high{place(mixed, Affine<float>{})};
  const Instanced top{high};
  for (const float x : {0.1F, 4.1F}) {
    const Ray<float> ray{.origin = {x, 0.2F, 3}, .direction = {0, 0, -1}};
    const auto hit = Bvh{top}.closest(ray);
    REQUIRE(hit);
    CHECK(hit->t == Approx(2));
    CHECK(top.within(*hit) == mixed.closest(ray));
    CHECK(top.surface(ray, *hit).normal == mixed.surface(ray, *mixed.closest(ray)).normal);
  }
}

TEST_CASE("instanced: many rays at once find what single rays do", "[geometry]") {
  const auto soup = glint::testing::triangle_soup<float>(60, 1);
  const Tree<float> object(view(soup));
  std::vector<Instance<Tree<float>>> instances;
  for (std::size_t i = 0; i < 5; ++i) instances.push_back(place(object, placement<float>(i)));
  const Bvh world{Instanced{instances}};
  std::vector<Ray<float>> rays;
  for (int i = 0; i < 1024; ++i)
    rays.push_back(
        {.origin = {0, 0, 6}, .direction = {float(i % 32) * 0.02F - 0.32F, float(i / 32) * 0.02F - 0.32F, -1}});
  std::vector<std::optional<Hit<float>>> hits(rays.size());
  world.closest(rays, hits);
  CHECK(std::count_if(hits.begin(), hits.end(), [](const auto& hit) { return hit.has_value(); }) > 50);
  for (std::size_t i = 0; i < rays.size(); ++i) CHECK(hits[i] == world.closest(rays[i]));
}

namespace {

/// Says that it has many primitives, and has none.
struct Huge {
  struct Set {
    using Scalar = float;
    using Index = std::uint32_t;
    [[nodiscard]] static std::size_t size() { return 100000; }
    [[nodiscard]] static glint::Aabb<float> bounds(Index /*i*/) { return {}; }
    [[nodiscard]] static std::size_t inner_values() { return 100000; }
  };
  using Scalar = float;
  using Index = std::uint32_t;
  [[nodiscard]] static Set set() { return {}; }
  [[nodiscard]] static glint::Aabb<float> bounds() { return {}; }
  [[nodiscard]] static std::optional<Hit<float>> closest(const Ray<float>& /*ray*/) { return std::nullopt; }
  [[nodiscard]] static bool occluded(const Ray<float>& /*ray*/) { return false; }
};

}  // namespace

TEST_CASE("instanced: more nested primitives than an index can count are an error", "[geometry]") {
  const Huge object;
  const std::vector<Instance<Huge>> instances{place(object, Affine<float>{})};
  CHECK_THROWS_AS(Instanced{instances}, std::length_error);
}

}  // namespace test_geometry_set_instanced

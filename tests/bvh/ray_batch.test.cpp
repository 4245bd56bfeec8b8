// SPDX-License-Identifier: MIT
#include <glint/bvh/ray_batch.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/catch.hpp>
#include <support/coherent_rays.hpp>

namespace test_bvh_ray_batch {

namespace {

using glint::Aabb;
using glint::Bvh;
using glint::Company;
using glint::Elements;
using glint::Ray;
using glint::RayPacket;
using glint::Vec3;

/// Counts answers of a batch that are not those of single rays, to the last bit.
template <typename B>
std::size_t wrong_answers(const B& bvh, const std::vector<Ray<typename B::Scalar>>& rays) {
  using Hit = glint::Hit<typename B::Scalar, typename B::Index>;
  std::vector<std::optional<Hit>> hits(rays.size(), Hit{.t = 7, .primitive = 7});  // to be overwritten
  const std::unique_ptr<bool[]> occluded(new bool[rays.size() + 1]);
  for (std::size_t i = 0; i < rays.size(); ++i) occluded[i] = i % 2 == 0;
  bvh.closest(rays, hits);
  bvh.occluded(rays, std::span(occluded.get(), rays.size()));
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < rays.size(); ++i)
    wrong += std::size_t(hits[i] != bvh.closest(rays[i])) + std::size_t(occluded[i] != bvh.occluded(rays[i]));
  return wrong;
}

/// Rays that go together, and rays that do not; the last set alternates, so that runs are of both kinds.
template <typename T>
std::vector<std::vector<Ray<T>>> ray_sets(const Aabb<T>& around, std::uint32_t seed) {
  const Aabb<T> box = is_empty(around) ? glint::testing::scene_box<T>() : around;
  std::vector<std::vector<Ray<T>>> sets;
  for (const T spread : {T(0.002), T(0.02), T(0.1)}) {
    sets.push_back(glint::testing::pencil_of_rays<T>(box, 96, spread, seed));
    sets.push_back(glint::testing::rays_toward_a_point<T>(box, 96, spread, seed));
  }
  sets.push_back(glint::testing::rays_within(box, 64, seed));
  sets.push_back(glint::testing::axis_aligned_rays(box, 64, seed));
  sets.push_back(glint::testing::rays_in_face_planes(box, 64, seed));
  glint::testing::RaySource<T> source(box, seed);
  std::vector<Ray<T>> mixed;
  for (std::size_t i = 0; i < 200; ++i) mixed.push_back(i / 16 % 3 == 1 ? source.next() : sets[2 + i / 16 % 2][i % 96]);
  sets.push_back(mixed);
  return sets;
}

template <typename B>
void check_batches(const B& bvh) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    CAPTURE(seed);
    for (const auto& rays : ray_sets(bvh.bounds(), seed)) CHECK(wrong_answers(bvh, rays) == 0);
  }
}

}  // namespace

TEMPLATE_TEST_CASE("ray batch: triangles are hit as by single rays, to the last bit", "[bvh][packet]", float, double) {
  using T = TestType;
  const std::vector<std::pair<std::string, glint::MeshBuffers<T>>> meshes{
      {"no triangle", {}},
      {"one triangle", glint::testing::identical_triangles<T>(1)},
      {"a cube, whose edges are hit", glint::testing::closed_cube<T>()},
      {"soup", glint::testing::triangle_soup<T>(400, 2)},
      {"slivers", glint::testing::diagonal_slivers<T>(150, 3)},
      {"equal triangles", glint::testing::identical_triangles<T>(100)},
      {"broken triangles", glint::testing::degenerate_mix<T>(200, 5)},
      {"a closed surface", glint::testing::scanned_blob<T>(2000, 6)},
      {"terrain", glint::testing::terrain<T>(300, 7)}};
  for (const auto& [name, buffers] : meshes) {
    CAPTURE(name);
    check_batches(Bvh(view(buffers)));
  }
}

TEST_CASE("ray batch: in any layout and leaves, rays hit what they hit alone", "[bvh][packet]") {
  const auto buffers = glint::testing::triangle_soup<float>(400, 2);
  const auto mesh = view(buffers);
  const glint::SweepSah builder;
  check_batches(Bvh(mesh, builder, glint::wide<4, glint::IndexedBlocks<4>>));
  check_batches(Bvh(mesh, glint::Median{.max_leaf_size = 1}, glint::binary));
  check_batches(Bvh(mesh, builder, glint::quantized<8>));
  check_batches(Bvh(glint::view<glint::MoellerTrumbore>(buffers)));
}

TEST_CASE("ray batch: any set of primitives is hit as by single rays", "[bvh][packet]") {
  std::mt19937 random(11);
  const auto uniform = [&] { return float(random()) * 0x1p-31F - 1; };
  std::vector<glint::Sphere<float>> shapes(50);
  for (auto& s : shapes) {
    s.center = {uniform(), uniform(), uniform()};
    s.radius = 0.15F * (uniform() + 1.1F);
  }
  const auto soup = glint::testing::triangle_soup<float>(150, 8);
  check_batches(Bvh(Elements{shapes}));
  check_batches(Bvh(glint::Joined{Elements{shapes}, view(soup), Elements{shapes}}));
}

TEST_CASE("ray batch: far from the origin and at all scales, too", "[bvh][packet]") {
  for (const float scale : {1e-6F, 1.0F, 1e6F}) {
    for (const float offset : {0.0F, 1e4F}) {
      auto buffers = glint::testing::scanned_blob<float>(400, 9);
      for (auto& p : buffers.positions) p = (p + offset) * scale;
      CAPTURE(scale, offset);
      check_batches(Bvh(view(buffers)));
    }
  }
}

TEST_CASE("ray batch: batches may have any size, nothing and odd ends too", "[bvh][packet]") {
  const auto buffers = glint::testing::scanned_blob<float>(2000, 3);
  const Bvh bvh(view(buffers));
  for (const std::size_t size : {0U, 1U, 7U, 8U, 15U, 16U, 17U, 64U, 65U, 1000U})
    for (std::uint32_t seed = 0; seed < 5; ++seed)
      CHECK(wrong_answers(bvh, glint::testing::pencil_of_rays(bvh.bounds(), size, 0.02F, seed)) == 0);
}

TEST_CASE("ray batch: one ray with a NaN, or without a direction, does not spoil the others", "[bvh][packet]") {
  const auto buffers = glint::testing::scanned_blob<float>(2000, 3);
  const Bvh bvh(view(buffers));
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 48; i += 5) {
    auto rays = glint::testing::pencil_of_rays(bvh.bounds(), 48, 0.02F, 2);
    auto& ray = rays[i];
    const auto original = ray;
    ray.direction.y = nan;
    CHECK(wrong_answers(bvh, rays) == 0);
    ray.direction = Vec3<float>(0);
    CHECK(wrong_answers(bvh, rays) == 0);
    ray = original;
    ray.t_max = nan;
    CHECK(wrong_answers(bvh, rays) == 0);
    ray = original;
    ray.t_min = -2;
    CHECK(wrong_answers(bvh, rays) == 0);
  }
}

namespace {

struct Runs {
  std::vector<std::size_t> together;  // where packets began
  std::vector<std::size_t> alone;
};

/// Which way rays went, where those that go together find the company good, or do not.
Runs runs_of(const std::vector<Ray<float>>& rays, bool good) {
  Runs runs;
  glint::for_each_packet(
      std::span<const Ray<float>>(rays), 2.0F,
      [&](const RayPacket<float>& packet, std::size_t first) {
        CHECK(packet.rays.data() == rays.data() + first);
        runs.together.push_back(first);
        return Company{.visits = 1, .rays = good ? 16 : 1};
      },
      [&](std::size_t i) { runs.alone.push_back(i); });
  return runs;
}

}  // namespace

TEST_CASE("ray batch: pencils of rays go together, rays in all directions do not", "[bvh][packet]") {
  const auto box = glint::testing::scene_box<float>();
  std::size_t runs = 0;
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    runs += runs_of(glint::testing::pencil_of_rays(box, 96, 0.02F, seed), true).together.size();
    runs += runs_of(glint::testing::rays_toward_a_point(box, 96, 0.02F, seed), true).together.size();
    CHECK(runs_of(glint::testing::rays_within(box, 96, seed), true).together.empty());
  }
  CHECK(runs > 120);  // of 240
}

TEST_CASE("ray batch: coherent runs of sixteen go together, and an end too short to pay alone", "[bvh][packet]") {
  const std::vector<Ray<float>> rays(37, {.direction = {0.1F, 0.2F, -1}});
  const Runs runs = runs_of(rays, true);
  CHECK(runs.together == std::vector<std::size_t>{0, 16});
  CHECK(runs.alone == std::vector<std::size_t>{32, 33, 34, 35, 36});
}

TEST_CASE("ray batch: rays of another course go alone", "[bvh][packet]") {
  std::vector<Ray<float>> rays(32, {.direction = {0.1F, 0.2F, -1}});
  for (const std::size_t i : {3U, 7U}) rays[i].direction.y = -0.2F;
  for (std::size_t i = 16; i < 32; i += 3) rays[i].direction.x = -0.1F;  // six, too few, and ten, enough
  const Runs runs = runs_of(rays, true);
  CHECK(runs.together == std::vector<std::size_t>{0, 16});
  CHECK(runs.alone == std::vector<std::size_t>{3, 7, 16, 19, 22, 25, 28, 31});
}

TEST_CASE("ray batch: where going together does not pay, it is tried ever more seldom, and again when it does",
          "[bvh][packet]") {
  const std::vector<Ray<float>> rays(std::size_t{16} * 100, {.direction = {0.1F, 0.2F, -1}});
  // After two failures the next 2 runs go untried, then 4, 8, 16, and 32 from then on.
  CHECK(runs_of(rays, false).together == std::vector<std::size_t>{0, 16, 16 * 4, 16 * 9, 16 * 18, 16 * 35, 16 * 68});
  CHECK(runs_of(rays, true).together.size() == 100);
  auto axis_parallel = rays;
  for (auto& ray : axis_parallel) ray.direction.x = 0;
  const Runs refused = runs_of(axis_parallel, true);
  CHECK(refused.together.empty());
  CHECK(refused.alone.size() == rays.size());
}

}  // namespace test_bvh_ray_batch

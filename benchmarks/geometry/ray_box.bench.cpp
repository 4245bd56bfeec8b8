// SPDX-License-Identifier: MIT
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glint/bvh/query/ray.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray_box.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/bench.hpp>

namespace {

using namespace glint;

constexpr std::size_t box_count = 1024;
constexpr std::size_t ray_count = 256;

template <typename T>
struct Input {
  std::vector<Aabb<T>> boxes;
  std::vector<Ray<T>> rays;
  std::size_t met = 0;  ///< pairs, by the one-off test

  Input() : rays(testing::rays_within(testing::scene_box<T>(), ray_count, 1)) {
    Random random(2);
    for (std::size_t i = 0; i < box_count; ++i) {
      const Vec3<T> corner = testing::detail::random_point(testing::scene_box<T>(), random);
      boxes.push_back({corner, corner + random.uniform_vec3<T>() * T(0.5)});
    }
    for (const Ray<T>& ray : rays)
      for (const Aabb<T>& box : boxes) met += intersect(ray, box).has_value();
  }
};

template <typename T>
void finish(benchmark::State& state, const Input<T>& input, std::size_t met) {
  state.counters["Mboxes/s"] =
      benchmark::Counter(double(box_count * ray_count) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  // Conservative tests may meet a few more: rays that graze.
  bench::verify(state, met >= input.met && met <= input.met + input.met / 1000 + 2, "the boxes met are not the ones");
}

template <typename T, typename Slab>
void slab(benchmark::State& state) {
  const Input<T> input;
  std::size_t met = 0;
  for (auto _ : state) {
    met = 0;
    for (const Ray<T>& ray : input.rays) {
      const auto prepared = Slab::prepare(ray);
      for (const Aabb<T>& box : input.boxes)
        met += Slab::intersect(prepared, box, ray.t_min, std::numeric_limits<T>::max()).has_value();
    }
    benchmark::DoNotOptimize(met);
  }
  finish(state, input, met);
}

template <typename T, int N>
void packed(benchmark::State& state) {
  const Input<T> input;
  std::vector<BoxPack<T, N>> packs(box_count / std::size_t(N));
  for (std::size_t i = 0; i < box_count; ++i) {
    const Aabb<T>& b = input.boxes[i];
    const std::array<T, 6> planes{b.lower.x, b.lower.y, b.lower.z, b.upper.x, b.upper.y, b.upper.z};
    for (std::size_t p = 0; p < 6; ++p) packs[i / std::size_t(N)].planes[p].set(int(i % std::size_t(N)), planes[p]);
  }
  const RayReach<T> reach = {.size = T(0.5), .farthest = T(1.5)};
  std::size_t met = 0;
  for (auto _ : state) {
    met = 0;
    for (const Ray<T>& ray : input.rays) {
      const RayQuery<T, N, RayOrder::Any> query(ray, reach);
      for (const BoxPack<T, N>& pack : packs) met += std::size_t(std::popcount(query.enter(pack).mask));
    }
    benchmark::DoNotOptimize(met);
  }
  finish(state, input, met);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, [](const bench::Options&) {
    benchmark::RegisterBenchmark("fast slab/float", slab<float, FastSlab>);
    benchmark::RegisterBenchmark("conservative slab/float", slab<float, ConservativeSlab>);
    benchmark::RegisterBenchmark("conservative slab/double", slab<double, ConservativeSlab>);
    benchmark::RegisterBenchmark("4 boxes at once/float", packed<float, 4>);
    benchmark::RegisterBenchmark("8 boxes at once/float", packed<float, 8>);
    benchmark::RegisterBenchmark("8 boxes at once/double", packed<double, 8>);
  });
}

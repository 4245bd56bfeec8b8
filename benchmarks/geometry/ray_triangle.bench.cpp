// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/random_scenes.hpp>

#include <support/bench.hpp>

namespace {

using namespace glint;

constexpr std::size_t triangle_count = 1024;
constexpr std::size_t ray_count = 256;

/// Triangles large enough that rays meet some of them.
template <typename T>
struct Input {
  MeshBuffers<T> buffers = testing::coincident_centroids<T>(triangle_count, 1);
  std::vector<Ray<T>> rays = testing::rays_within(testing::scene_box<T>(), ray_count, 2);

  /// Σ t, in double precision: the answer of an independent path.
  [[nodiscard]] double expected() const {
    MeshBuffers<double> exact;
    for (const auto& p : buffers.positions) exact.positions.emplace_back(p);
    exact.indices = buffers.indices;
    const auto mesh = view<MoellerTrumbore>(exact);
    double sum = 0;
    for (const Ray<T>& ray : rays) {
      const Ray<double> same{Vec3<double>(ray.origin), Vec3<double>(ray.direction)};
      for (std::uint32_t i = 0; i < mesh.size(); ++i)
        if (const auto hit = mesh.intersect(same, i)) sum += std::min(hit->t, 10.0);
    }
    return sum;
  }
};

template <typename T>
void finish(benchmark::State& state, const Input<T>& input, double sum) {
  state.counters["Mtriangles/s"] =
      benchmark::Counter(double(triangle_count * ray_count) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  const double expected = input.expected();
  bench::verify(state, std::abs(sum - expected) <= 1e-3 * expected, "the sum of all hits' t is not right");
}

template <typename T, typename Intersector>
void triangles(benchmark::State& state) {
  const Input<T> input;
  const auto mesh = view<Intersector>(input.buffers);
  double sum = 0;
  for (auto _ : state) {
    sum = 0;
    for (const Ray<T>& ray : input.rays) {
      const auto prepared = mesh.prepare(ray);
      for (std::uint32_t i = 0; i < mesh.size(); ++i)
        if (const auto hit = mesh.intersect(ray, prepared, i)) sum += std::min(double(hit->t), 10.0);
    }
    benchmark::DoNotOptimize(sum);
  }
  finish(state, input, sum);
}

/// Blocks look for the closest hit: here, of the triangles of one block.
template <typename T, int N>
void blocks(benchmark::State& state) {
  const Input<T> input;
  const auto mesh = view(input.buffers);
  auto tree = Median{.max_leaf_size = 1}.build(mesh);  // one triangle a block: every hit is the closest of its block
  const auto all = make_leaves(mesh, tree, CopiedBlocks<N>{}, Serial{});
  double sum = 0;
  for (auto _ : state) {
    sum = 0;
    for (const Ray<T>& ray : input.rays) {
      const auto prepared = all.prepare(mesh, ray);
      for (std::uint32_t i = 0; i < triangle_count; ++i) {
        Hit<T> best{.t = ray.t_max};
        if (all.closest(mesh, ray, prepared, {i, 1}, best)) sum += std::min(double(best.t), 10.0);
      }
    }
    benchmark::DoNotOptimize(sum);
  }
  finish(state, input, sum);
}

}  // namespace

int main(int argc, char** argv) {
  return bench::run(argc, argv, [](const bench::Options&) {
    benchmark::RegisterBenchmark("Moeller-Trumbore/float", triangles<float, MoellerTrumbore>);
    benchmark::RegisterBenchmark("Moeller-Trumbore/double", triangles<double, MoellerTrumbore>);
    benchmark::RegisterBenchmark("watertight/float", triangles<float, Watertight>);
    benchmark::RegisterBenchmark("watertight/double", triangles<double, Watertight>);
    benchmark::RegisterBenchmark("watertight, a block of 4 for each/float", blocks<float, 4>);
    benchmark::RegisterBenchmark("watertight, a block of 8 for each/float", blocks<float, 8>);
  });
}

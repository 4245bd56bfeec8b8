// SPDX-License-Identifier: MIT
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/core/executor.hpp>
#include <glint/geometry/triangle_mesh.hpp>

#include <support/bench.hpp>

#if __has_include(<tbb/task_arena.h>)
#include <glint/core/tbb_executor.hpp>
#endif

namespace {

using namespace glint;

/// Builds trees; each must be valid, and the one that Serial builds.
template <typename Builder, typename E>
void build(benchmark::State& state, const MeshBuffers<float>& buffers, const Builder& builder, const E& executor) {
  const auto mesh = view(buffers);
  Tree<float> tree;
  for (auto _ : state) {
    tree = builder.build(mesh, executor);
    benchmark::DoNotOptimize(tree.nodes.data());
  }
  if (!bench::verify(state, violations(tree, mesh).empty(), "the tree is not valid")) return;
  if (!bench::verify(state, tree == builder.build(mesh), "the tree depends on the executor")) return;
  const auto triangles = double(mesh.size());
  state.counters["Mtriangles/s"] = benchmark::Counter(triangles * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["SAH"] = statistics(tree).sah_cost;
  state.counters["bytes/triangle"] = double(Bvh(mesh, std::move(tree)).bytes()) / triangles;
}

template <typename Builder>
void register_builder(const std::string& name, const bench::NamedMesh& mesh, const Builder& builder) {
  const auto add = [&](const std::string& threads, const auto& executor) {
    benchmark::RegisterBenchmark(
        (name + '/' + mesh.name + threads).c_str(),
        [&buffers = mesh.buffers, builder, &executor](auto& state) { build(state, buffers, builder, executor); })
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  static const Serial serial;
  add("/1 thread", serial);
#if __has_include(<tbb/task_arena.h>)
  static const TbbExecutor parallel;
  add("/all threads", parallel);
#endif
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<bench::NamedMesh> meshes;
  return bench::run(argc, argv, [&](const bench::Options& options) {
    meshes = bench::meshes(options);
    for (const bench::NamedMesh& mesh : meshes) {
      register_builder("median", mesh, Median{});
      register_builder("morton", mesh, Morton{});
      register_builder("binned sah", mesh, BinnedSah{});
      register_builder("sweep sah", mesh, SweepSah{});
    }
  });
}

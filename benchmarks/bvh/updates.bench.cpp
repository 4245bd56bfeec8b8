// SPDX-License-Identifier: MIT
// What changes to a tree take, in turns with what they replace: a tree built anew. Each tree must be valid and cost
// about what the new one does. And what the upper of two levels takes, for a thousand instances.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/insert.hpp>
#include <glint/bvh/pass/rebuild.hpp>
#include <glint/bvh/pass/refit.hpp>
#include <glint/bvh/pass/remove.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/bvh/pass/validate.hpp>
#include <glint/geometry/boxes.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/random.hpp>

#include <support/bench.hpp>
#include <support/timing.hpp>

namespace {

using namespace glint;

/// Times a change and a build in turns; both must end in a valid tree over the set, of about the same cost.
template <typename S, typename Change>
void race(benchmark::State& state, const S& set, const Change& change) {
  Tree<float> changed;
  Tree<float> built;
  std::vector<double> changing;
  std::vector<double> building;
  for (auto _ : state) {
    changing.push_back(bench::seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { changed = change(); }));
    building.push_back(bench::seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { built = BinnedSah{}.build(set); }));
    state.SetIterationTime(changing.back());
  }
  if (!bench::verify(state, violations(changed, set).empty(), "the tree is not valid")) return;
  const double cost_ratio = statistics(changed).sah_cost / statistics(built).sah_cost;
  if (!bench::verify(state, cost_ratio < 1.1, "the tree costs more than a new one")) return;
  state.counters["time/new"] = bench::median_ratio(changing, building);
  state.counters["SAH/new"] = cost_ratio;
}

[[nodiscard]] std::vector<std::uint32_t> some_of(std::size_t n, std::size_t count) {
  std::vector<std::uint32_t> all(n);
  for (std::size_t i = 0; i != n; ++i) all[i] = std::uint32_t(i);
  std::shuffle(all.begin(), all.end(), std::mt19937(1));
  all.resize(count);
  return all;
}

[[nodiscard]] std::vector<Aabb<float>> boxes_of(const MeshBuffers<float>& buffers) {
  const auto mesh = view(buffers);
  std::vector<Aabb<float>> boxes;
  for (std::uint32_t i = 0; i != mesh.size(); ++i) boxes.push_back(mesh.bounds(i));
  return boxes;
}

void remove_some(benchmark::State& state, const MeshBuffers<float>& buffers, std::size_t share) {
  auto boxes = boxes_of(buffers);
  const auto tree = BinnedSah{}.build(Boxes{boxes});
  const auto some = some_of(boxes.size(), boxes.size() / share);
  for (const std::uint32_t i : some) boxes[i] = {};
  race(state, Boxes{boxes}, [&] { return remove(tree, Boxes{boxes}, some); });
}
void insert_some(benchmark::State& state, const MeshBuffers<float>& buffers, std::size_t share) {
  const auto boxes = boxes_of(buffers);
  const auto some = some_of(boxes.size(), boxes.size() / share);
  const auto tree = remove(BinnedSah{}.build(Boxes{boxes}), Boxes{boxes}, some);
  race(state, Boxes{boxes}, [&] { return insert(tree, Boxes{boxes}, some); });
}
/// Of the mesh, what lies in a fiftieth of its width is shaken.
void rebuild_some(benchmark::State& state, const MeshBuffers<float>& buffers) {
  auto moved = buffers;
  const auto built = BinnedSah{}.build(view(buffers));
  const Aabb<float> all = built.nodes[0].bounds;
  Random random(1);
  for (auto& p : moved.positions)
    if (p.x < all.lower.x + 0.02F * extent(all).x) p += 0.05F * (random.uniform_vec3<float>() - 0.5F);
  auto tree = built;
  refit(tree, view(moved));
  race(state, view(moved), [&] { return rebuild(tree, view(moved), built).tree; });
}

/// A Bvh of instances, built and refitted for each frame: what rays meet is what they meet one by one.
template <typename Update>
void upper_level(benchmark::State& state, const Update& update) {
  const auto blob = testing::scanned_blob<float>(5000, 1);
  const Bvh stone(view(blob));
  const auto field = [&](float angle) {
    Random random(1);
    std::vector<Instance<Bvh<TriangleMesh<float>>>> stones;
    for (int i = 0; i < 1000; ++i) {
      const int row = i / 40;
      const glm::vec3 spot{float(i % 40), 2 * random.uniform<float>(), float(row)};
      stones.push_back(
          place(stone, Affine<float>::translate(spot) * Affine<float>::rotate({1, 0, 1}, angle + float(i)) *
                           Affine<float>::scale(glm::vec3(0.4F))));
    }
    return stones;
  };
  auto stones = field(0);
  Bvh world{Instanced{stones}};
  float angle = 0;
  for (auto _ : state) {
    stones = field(angle += 0.1F);
    state.SetIterationTime(bench::seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { update(world, Instanced{stones}); }));
  }
  const BruteForce every{Instanced{stones}};
  std::size_t hits = 0;
  for (int i = 0; i < 200; ++i) {
    const int row = i / 40;
    const Ray<float> ray{.origin = {float(i % 40), 9, float(row)}, .direction = {0.02F, -1, 0.02F}};
    const auto hit = world.closest(ray);
    if (!bench::verify(state, hit == every.closest(ray), "a ray meets something else")) return;
    hits += std::size_t(hit.has_value());
  }
  bench::verify(state, hits > 20, "rays meet too little");
}

template <typename Body>
void add(const std::string& name, const Body& body) {
  benchmark::RegisterBenchmark(name.c_str(), body)->Unit(benchmark::kMillisecond)->UseManualTime();
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<bench::NamedMesh> meshes;
  return bench::run(argc, argv, [&](const bench::Options& options) {
    meshes = bench::meshes(options);
    for (const bench::NamedMesh& mesh : meshes) {
      const auto& buffers = mesh.buffers;
      for (const std::size_t share : {20U, 100U, 1000U}) {
        const std::string what = "/1 in " + std::to_string(share) + '/' + mesh.name;
        add("remove" + what, [&buffers, share](auto& state) { remove_some(state, buffers, share); });
        add("insert" + what, [&buffers, share](auto& state) { insert_some(state, buffers, share); });
      }
      add("rebuild/" + mesh.name, [&buffers](auto& state) { rebuild_some(state, buffers); });
    }
    add("upper level/build",
        [](auto& state) { upper_level(state, [](auto& world, const auto& set) { world = Bvh{set}; }); });
    add("upper level/refit", [](auto& state) {
      upper_level(state, [](auto& world, const auto& set) { static_cast<void>(world.refit(set)); });
    });
  });
}

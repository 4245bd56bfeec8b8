// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/bvh/leaves.hpp>
#include <glint/bvh/tree.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/bench.hpp>
#include <support/timing.hpp>

/// What a node costs a ray, what a leaf does, and each block of triangles in it. Trees of many leaf sizes are timed,
/// then walked again by copies that count; least squares tell the costs apart. Builders weigh binary nodes, of which a
/// wide one takes in several: what they take as traversal_cost over intersection_cost is a binary node's part of a wide
/// one, against a leaf of one block.
namespace {

using namespace glint;
using Mesh = decltype(view(std::declval<const MeshBuffers<float>&>()));
using Rays = std::vector<Ray<float>>;

struct Counts {
  std::size_t nodes = 0;
  std::size_t leaves = 0;
  std::size_t blocks = 0;
};
/// Of the walk that counts; there is one at a time.
Counts& counts() {
  static Counts now;
  return now;
}

template <Layout L>
class CountedNodes : public L {
 public:
  explicit CountedNodes(L nodes) : L(std::move(nodes)) {}
  [[nodiscard]] decltype(auto) children(typename L::Index node) const {
    ++counts().nodes;
    return L::children(node);
  }
};

template <typename L>
class CountedLeaves : public L {
 public:
  explicit CountedLeaves(L leaves) : L(std::move(leaves)) {}
  template <typename Prepared, typename I>
  bool closest(const Mesh& mesh, const Ray<float>& ray, const Prepared& prepared, Slots<I> slots,
               Hit<float, I>& best) const {
    ++counts().leaves;
    counts().blocks += slots.count;
    return L::closest(mesh, ray, prepared, slots, best);
  }
};

template <typename Choice>
struct Counted {};
template <typename Choice, Executor E>
[[nodiscard]] auto make_leaves(const Mesh& mesh, Tree<float>& tree, Counted<Choice> /*choice*/, const E& executor) {
  return CountedLeaves(make_leaves(mesh, tree, Choice{}, executor));
}

template <typename LayoutName>
struct CountedLayout {
  using Leaves = Counted<typename LayoutName::Leaves>;
  template <std::floating_point T, std::unsigned_integral I>
  using Nodes = CountedNodes<typename LayoutName::template Nodes<T, I>>;

  template <std::floating_point T, std::unsigned_integral I, Executor E>
  [[nodiscard]] Nodes<T, I> nodes(const Tree<T, I>& tree, const E& executor) const {
    return Nodes<T, I>(LayoutName{}.template nodes<T, I>(tree, executor));
  }
};

/// Of a ray, on average.
struct Sample {
  double nodes = 0;
  double leaves = 0;
  double blocks = 0;
  double binary_nodes = 0;  ///< where each stands for itself
  double seconds = 0;
};
/// In seconds.
struct Costs {
  double ray = 0;
  double node = 0;
  double leaf = 0;
  double block = 0;

  [[nodiscard]] double of(const Sample& s) const { return ray + node * s.nodes + leaf * s.leaves + block * s.blocks; }
};

template <typename B>
[[nodiscard]] std::size_t hits(const B& bvh, const Rays& rays, std::size_t begin, std::size_t end) {
  std::size_t n = 0;
  for (std::size_t i = begin; i != end; ++i) n += std::size_t(bvh.closest(rays[i]).has_value());
  return n;
}

/// The sum of the least times of small runs of rays, in which others on the machine seldom interfere.
template <typename B>
[[nodiscard]] double least_seconds(const B& bvh, const Rays& rays, int repetitions) {
  constexpr std::size_t run = 500;
  double sum = 0;
  for (std::size_t begin = 0; begin < rays.size(); begin += run) {
    double least = infinity<double>;
    for (int i = 0; i < repetitions; ++i) {
      const auto work = [&] { benchmark::DoNotOptimize(hits(bvh, rays, begin, std::min(begin + run, rays.size()))); };
      least = std::min(least, bench::seconds_of(CLOCK_THREAD_CPUTIME_ID, work));
    }
    sum += least;
  }
  return sum;
}

template <typename B>
[[nodiscard]] bool agrees_with_brute_force(const B& bvh, const Rays& rays) {
  const BruteForce oracle(bvh.set());
  const std::size_t step = rays.size() / std::clamp<std::size_t>(2'000'000 / bvh.set().size(), 2, rays.size()) + 1;
  for (std::size_t i = 0; i < rays.size(); i += step)
    if (!testing::agree(rays[i], bvh.closest(rays[i]), oracle.closest(rays[i]))) return false;
  return true;
}

template <typename LayoutName>
[[nodiscard]] Sample sample_of(const Mesh& mesh, const Tree<float>& tree, const Rays& rays, int repetitions) {
  const Bvh bvh(mesh, tree, LayoutName{});
  const std::size_t expected = hits(bvh, rays, 0, rays.size());
  const auto counted = [&](const auto& copy) {
    counts() = {};
    if (hits(copy, rays, 0, rays.size()) != expected) bench::any_wrong() = true;
    return counts();
  };
  const Counts wide = counted(Bvh(mesh, tree, CountedLayout<LayoutName>{}));
  const Counts narrow = counted(Bvh(mesh, tree, CountedLayout<BinaryLayout<typename LayoutName::Leaves>>{}));
  if (!agrees_with_brute_force(bvh, rays)) bench::any_wrong() = true;
  const auto each = 1 / double(rays.size());
  return {each * double(wide.nodes), each * double(wide.leaves), each * double(wide.blocks),
          each * double(narrow.nodes), each * least_seconds(bvh, rays, repetitions)};
}

template <typename LayoutName>
[[nodiscard]] std::vector<Sample> samples_of(const Mesh& mesh, const bench::Options& options) {
  std::vector<Sample> samples;
  const std::size_t n = options.quick ? 200 : 4000;
  for (const std::size_t leaf : {1U, 4U, 8U, 16U, 32U, 64U}) {
    for (const float node_cost : {0.1F, 1.0F, 8.0F}) {
      const BinnedSah builder{
          .traversal_cost = node_cost, .block_size = std::min<std::size_t>(leaf, 8), .max_leaf_size = leaf};
      const Tree<float> tree = builder.build(mesh);
      const Aabb<float> box = tree.nodes.front().bounds;
      for (const Rays& rays : {testing::rays_within(box, n, 1), testing::rays_into(box, n, 2)})
        samples.push_back(sample_of<LayoutName>(mesh, tree, rays, options.quick ? 1 : 15));
    }
  }
  return samples;
}

/// Each sample is weighed by 1 / seconds: errors count in proportion.
[[nodiscard]] Costs least_squares(const std::vector<Sample>& samples) {
  constexpr std::size_t n = 4;
  std::array<std::array<double, n + 1>, n> m{};
  for (const Sample& s : samples) {
    const std::array<double, n + 1> row{1 / s.seconds, s.nodes / s.seconds, s.leaves / s.seconds, s.blocks / s.seconds,
                                        1};
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j <= n; ++j) m[i][j] += row[i] * row[j];
  }
  for (std::size_t i = 0; i < n; ++i) {  // elimination; the matrix is symmetric and positive, so needs no pivoting
    for (std::size_t k = 0; k < n; ++k) {
      if (k == i) continue;
      const double factor = m[k][i] / m[i][i];
      for (std::size_t j = i; j <= n; ++j) m[k][j] -= factor * m[i][j];
    }
  }
  return {m[0][n] / m[0][0], m[1][n] / m[1][1], m[2][n] / m[2][2], m[3][n] / m[3][3]};
}

template <typename LayoutName>
void report(const char* name, const std::vector<bench::NamedMesh>& meshes, const bench::Options& options) {
  std::vector<Sample> samples;
  for (const bench::NamedMesh& mesh : meshes) {
    const std::vector<Sample> more = samples_of<LayoutName>(view(mesh.buffers), options);
    samples.insert(samples.end(), more.begin(), more.end());
  }
  const Costs costs = least_squares(samples);
  std::vector<double> errors;
  std::vector<double> shares;
  for (const Sample& s : samples) {
    errors.push_back(std::abs(costs.of(s) - s.seconds) / s.seconds);
    if (s.binary_nodes > 0) shares.push_back(s.nodes / s.binary_nodes);
  }
  const double binary = costs.node * bench::median(shares);
  std::printf("%-24s node %5.2f ns, leaf %5.2f ns, each block %5.2f ns (%.0f %% off); ", name, costs.node * 1e9,
              costs.leaf * 1e9, costs.block * 1e9, 100 * bench::median(errors));
  std::printf("a binary node %5.2f ns, %.2f of a leaf of one block\n", binary * 1e9,
              binary / (costs.leaf + costs.block));
}

}  // namespace

int main(int argc, char** argv) try {
  std::vector<char*> arguments(argv, argv + argc);
  bench::Options options = bench::parse_options(arguments);
  options.max_triangles = std::min<std::size_t>(options.max_triangles, options.quick ? 1000 : 100'000);
  const std::vector<bench::NamedMesh> meshes = bench::meshes(options);
  report<WideLayout<8, CopiedBlocks<4>>>("wide 8, copied 4", meshes, options);
  report<WideLayout<8, CopiedBlocks<8>>>("wide 8, copied 8", meshes, options);
  report<WideLayout<8, IndexedBlocks<8>>>("wide 8, indexed 8", meshes, options);
  report<QuantizedLayout<8, IndexedBlocks<4>>>("quantized 8, indexed 4", meshes, options);
  report<QuantizedLayout<8, IndexedBlocks<8>>>("quantized 8, indexed 8", meshes, options);
  if (bench::any_wrong()) std::cerr << "a ray found something else than brute force did\n";
  return bench::any_wrong() ? EXIT_FAILURE : EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

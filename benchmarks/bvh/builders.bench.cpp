// SPDX-License-Identifier: MIT
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <new>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/pass/merge_leaves.hpp>
#include <glint/bvh/pass/reinsert.hpp>
#include <glint/geometry/triangle_mesh.hpp>

#include <support/meshes.hpp>
#include <support/named_mesh.hpp>
#include <support/ray_sets.hpp>
#include <support/timing.hpp>

/// What every builder takes in time and memory, and what rays gain by it: a table, and a plot of it.

namespace {

std::size_t bytes_in_use = 0;
std::size_t most_bytes_in_use = 0;

[[nodiscard]] void* counted(void* memory) {
  if (memory == nullptr) throw std::bad_alloc();
  bytes_in_use += malloc_usable_size(memory);
  most_bytes_in_use = std::max(most_bytes_in_use, bytes_in_use);
  return memory;
}
void give_back(void* memory) noexcept {
  bytes_in_use -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

// This program's own: it counts what is allocated, on its only thread.
void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto multiple = std::size_t(alignment);
  return counted(std::aligned_alloc(multiple, (size + multiple - 1) / multiple * multiple));
}
void operator delete(void* memory) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t /*size*/) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::align_val_t /*alignment*/) noexcept {
  give_back(memory);
}
void operator delete(void* memory, std::size_t /*size*/, std::align_val_t /*alignment*/) noexcept {
  give_back(memory);
}

namespace {

using namespace glint;
using namespace glint::bench;

using Mesh = TriangleMesh<float, std::uint32_t>;
using MeshBvh = Bvh<Mesh>;

struct NamedBuilder {
  std::string name;
  std::function<Tree<float>(const Mesh&)> build;
};

[[nodiscard]] std::vector<NamedBuilder> builders() {
  constexpr std::size_t block = MeshBvh::Leaves::block_size;
  const auto best = QualityBuilder{.quality = Quality::Best, .block_size = block};
  return {{"Median", [](const Mesh& mesh) { return Median{.max_leaf_size = block}.build(mesh); }},
          {"Morton (fast)", [](const Mesh& mesh) { return Morton{.block_size = block}.build(mesh); }},
          {"BinnedSah (balanced)", [](const Mesh& mesh) { return BinnedSah{.block_size = block}.build(mesh); }},
          {"BinnedSah, reinsert",
           [](const Mesh& mesh) {
             return merge_leaves(reinsert(BinnedSah{.block_size = block}.build(mesh)), {.block_size = block});
           }},
          {"SweepSah", [](const Mesh& mesh) { return SweepSah{.block_size = block}.build(mesh); }},
          {"SpatialSah", [](const Mesh& mesh) { return SpatialSah{.block_size = block}.build(mesh); }},
          {"SpatialSah, reinsert (best)", [best](const Mesh& mesh) { return best.build(mesh); }}};
}
constexpr std::size_t balanced = 2;

/// Of one builder on one mesh.
struct Figures {
  std::vector<double> build;                  ///< seconds of each repetition, up to a Bvh that takes rays
  std::array<std::vector<double>, 2> rays{};  ///< seconds of each repetition, of camera rays and of bounces
  double sah_cost = 0;
  double bytes = 0;  ///< a triangle, beside the mesh
  double peak = 0;   ///< the same while it is built
};

struct Comparison {
  std::string mesh;
  std::vector<Figures> of;  ///< each builder
};

[[nodiscard]] std::vector<std::optional<Hit<float>>> trace(const MeshBvh& bvh, const Rays& rays, Figures& figures,
                                                           std::size_t set) {
  std::vector<std::optional<Hit<float>>> hits(rays.size());
  figures.rays[set].push_back(seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = bvh.closest(rays[i]);
  }));
  return hits;
}

/// Builds in turns, then rays in turns, so that what disturbs the machine disturbs all.
[[nodiscard]] Comparison compare(const NamedMesh& named, int repetitions, std::size_t ray_count) {
  const auto all = builders();
  const Mesh mesh = view(named.buffers);
  const auto triangles = double(mesh.size());
  Comparison result{named.name, std::vector<Figures>(all.size())};
  std::vector<MeshBvh> trees;
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    trees.clear();
    for (std::size_t i = 0; i < all.size(); ++i) {
      Figures& figures = result.of[i];
      const std::size_t before = most_bytes_in_use = bytes_in_use;
      std::optional<MeshBvh> made;
      figures.build.push_back(seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] { made.emplace(mesh, all[i].build(mesh)); }));
      figures.peak = double(most_bytes_in_use - before) / triangles;
      figures.bytes = double(made->bytes()) / triangles;
      figures.sah_cost = made->statistics().sah_cost;
      trees.push_back(std::move(*made));
    }
  }
  const auto sets =
      ray_sets(trees[balanced], named.viewpoint.value_or(look_at_all(trees[balanced].bounds())), ray_count);
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    for (std::size_t set = 0; set < 2; ++set) {
      const auto expected = trace(trees[0], sets[set].rays, result.of[0], set);
      for (std::size_t i = 1; i < all.size(); ++i)
        if (trace(trees[i], sets[set].rays, result.of[i], set) != expected)
          throw std::runtime_error(named.name + ": rays find other hits by " + all[i].name + " than by " + all[0].name);
    }
  }
  return result;
}

[[nodiscard]] double build_ratio(const Comparison& c, std::size_t i) {
  return median_ratio(c.of[i].build, c.of[balanced].build);
}
[[nodiscard]] double rays_ratio(const Comparison& c, std::size_t i, std::size_t set) {
  return median_ratio(c.of[balanced].rays[set], c.of[i].rays[set]);
}
[[nodiscard]] double sah_ratio(const Comparison& c, std::size_t i) {
  return c.of[i].sah_cost / c.of[balanced].sah_cost;
}

void print(const Comparison& c) {
  std::printf("\n%s; ratios to BinnedSah of the same run\n\n", c.mesh.c_str());
  std::printf("| builder | build | SAH cost | camera rays/s | bounces/s | bytes a triangle | at most, while built |\n");
  std::printf("|---|---|---|---|---|---|---|\n");
  const auto all = builders();
  for (std::size_t i = 0; i < all.size(); ++i)
    std::printf("| %s | %.2f | %.2f | %.2f | %.2f | %.0f | %.0f |\n", all[i].name.c_str(), build_ratio(c, i),
                sah_ratio(c, i), rays_ratio(c, i, 0), rays_ratio(c, i, 1), c.of[i].bytes, c.of[i].peak);
}

/// A plot as SVG: building time along x, on a logarithmic scale, against one quantity; a digit for each builder, a
/// color for each mesh.
class Panel {
 public:
  Panel(std::ostream& out, double left, std::string title, double low, double high)
      : out_(out), left_(left), title_(std::move(title)), low_(low), high_(high) {}

  void axes() const {
    out_ << "<rect x='" << left_ << "' y='" << top << "' width='" << width << "' height='" << height
         << "' fill='none' stroke='#888'/>\n";
    text(left_ + width / 2, top - 12, title_, "middle");
    text(left_ + width / 2, top + height + 36, "time to build, BinnedSah = 1", "middle");
    for (const double x : {0.125, 0.25, 0.5, 1.0, 2.0, 4.0, 8.0, 16.0}) {
      line(at_x(x), top, at_x(x), top + height);
      text(at_x(x), top + height + 16, label(x), "middle");
    }
    const double step = (high_ - low_) / 6;
    for (int i = 0; i <= 6; ++i) {
      const double y = low_ + step * i;
      line(left_, at_y(y), left_ + width, at_y(y));
      text(left_ - 6, at_y(y) + 4, label(y), "end");
    }
  }
  void point(double x, double y, std::size_t builder, const char* color) const {
    out_ << "<circle cx='" << at_x(x) << "' cy='" << at_y(y) << "' r='8' fill='" << color << "'/>\n";
    text(at_x(x), at_y(y) + 4, std::to_string(builder + 1), "middle", "#fff");
  }
  void text(double x, double y, const std::string& what, const char* anchor, const char* color = "#444") const {
    out_ << "<text x='" << x << "' y='" << y << "' text-anchor='" << anchor << "' fill='" << color << "'>" << what
         << "</text>\n";
  }

  static constexpr double top = 40;
  static constexpr double width = 340;
  static constexpr double height = 300;

 private:
  [[nodiscard]] double at_x(double x) const {
    return left_ + width * (std::log2(std::clamp(x, 0.1, 20.0)) + 3.3) / 7.6;
  }
  [[nodiscard]] double at_y(double y) const {
    return top + height * (high_ - std::clamp(y, low_, high_)) / (high_ - low_);
  }
  [[nodiscard]] static std::string label(double value) {
    std::array<char, 16> digits{};
    std::snprintf(digits.data(), digits.size(), "%.3g", value);
    return digits.data();
  }
  void line(double x1, double y1, double x2, double y2) const {
    out_ << "<line x1='" << x1 << "' y1='" << y1 << "' x2='" << x2 << "' y2='" << y2 << "' stroke='#ddd'/>\n";
  }

  std::ostream& out_;
  double left_;
  std::string title_;
  double low_;
  double high_;
};

void plot(const std::vector<Comparison>& comparisons, const std::string& file) {
  constexpr std::array colors{"#2f6db3", "#c8571b", "#3a8f5c", "#8d4fa3"};
  std::ofstream out(file);
  out << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 860 500' font-family='sans-serif' font-size='12'>\n"
      << "<rect width='860' height='500' fill='#fff'/>\n";
  const Panel costs(out, 60, "SAH cost, BinnedSah = 1 (lower is better)", 0.8, 2.3);
  const Panel rays(out, 480, "bounces a second, BinnedSah = 1 (higher is better)", 0.6, 1.2);
  costs.axes();
  rays.axes();
  const auto all = builders();
  for (std::size_t m = 0; m < comparisons.size(); ++m) {
    const Comparison& c = comparisons[m];
    const char* color = colors[m % colors.size()];
    for (std::size_t i = 0; i < all.size(); ++i) {
      costs.point(build_ratio(c, i), sah_ratio(c, i), i, color);
      rays.point(build_ratio(c, i), rays_ratio(c, i, 1), i, color);
    }
    costs.text(60 + 130 * double(m), 484, c.mesh, "start", color);
  }
  for (std::size_t i = 0; i < all.size(); ++i)
    costs.text(60 + 200 * double(i % 4), 410 + 24 * double(i / 4), std::to_string(i + 1) + "  " + all[i].name, "start");
  out << "</svg>\n";
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

struct BuildersOptions {
  bool help = false;
  bool quick = false;
  std::string plot;
};

[[nodiscard]] BuildersOptions parse(const std::vector<std::string>& arguments) {
  BuildersOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--help")
      options.help = true;
    else if (arguments[i] == "--quick")
      options.quick = true;
    else if (arguments[i] == "--plot" && i + 1 < arguments.size())
      options.plot = arguments[++i];
    else
      throw std::runtime_error("found '" + arguments[i] + "', expected --quick, --plot FILE.svg or --help");
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) try {
  const BuildersOptions options = parse({argv + 1, argv + argc});
  if (options.help) {
    std::puts("bench_builders [--quick] [--plot FILE.svg]\n\nCompares all builders on one thread, in turns.");
    return EXIT_SUCCESS;
  }
  std::vector<Comparison> comparisons;
  for (const MeshMaker& maker : mesh_makers()) {
    if (maker.triangles > 300'000) continue;
    const NamedMesh mesh = maker.make(options.quick ? 2000 : maker.triangles);
    comparisons.push_back(compare(mesh, options.quick ? 1 : 7, options.quick ? 1000 : 200'000));
    print(comparisons.back());
  }
  if (!options.plot.empty()) plot(comparisons, options.plot);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_builders: %s\n", error.what());
  return EXIT_FAILURE;
}

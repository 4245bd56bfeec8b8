// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include <glint/core/executor.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/constants.hpp>

#include <peers/contenders.hpp>
#include <peers/embree.hpp>
#include <peers/judge.hpp>
#include <peers/options.hpp>
#include <peers/ray_sets.hpp>
#include <peers/timing.hpp>
#include <support/meshes.hpp>
#include <support/named_mesh.hpp>

namespace {

using namespace glint;
using namespace glint::bench;

using Contenders = std::vector<Contender>;
using Answers = std::vector<Hit<float>>;

/// Seconds of each repetition, for each contender.
using Times = std::vector<std::vector<double>>;

struct Measured {
  RaySet set;
  Times times;
  std::vector<Answers> answers;  ///< of each contender
};

[[nodiscard]] bool is_ours(const Contender& c) {
  return !c.like.empty();
}

/// All contenders answer all rays, a slice at a time, each slice by all of them before the next. Who begins changes
/// from slice to slice, and so does the direction of the round.
void run_once(const Contenders& contenders, Measured& measured, std::size_t repetition) {
  const std::span<const Ray<float>> rays = measured.set.rays;
  const std::size_t slice = 1 << 14;
  const std::size_t n = contenders.size();
  for (std::vector<double>& times : measured.times) times.push_back(0);
  for (std::size_t first = 0, turn = repetition; first < rays.size(); first += slice, ++turn) {
    const std::size_t count = std::min(slice, rays.size() - first);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t who = turn / n % 2 == 0 ? (turn + i) % n : (turn + n - i) % n;
      const std::span answers = std::span(measured.answers[who]).subspan(first, count);
      measured.times[who].back() += seconds_of(CLOCK_THREAD_CPUTIME_ID, [&] {
        contenders[who].answer(measured.set.question, rays.subspan(first, count), answers);
      });
    }
  }
}

/// One repetition to warm up, then as many as take every contender long enough.
[[nodiscard]] Measured run(const Contenders& contenders, RaySet set, bool quick) {
  Measured measured{std::move(set), Times(contenders.size()), {}};
  measured.answers.assign(contenders.size(), Answers(measured.set.rays.size(), Hit<float>{.t = infinity<float>}));
  if (measured.set.rays.empty())
    throw std::runtime_error("no ray of the set '" + measured.set.name + "' starts anywhere");
  run_once(contenders, measured, 0);
  double shortest = infinity<double>;
  for (std::vector<double>& times : measured.times) {
    shortest = std::min(shortest, times.back());
    times.clear();
  }
  const int rounds = quick ? 1 : std::max(1, int(std::ceil(0.02 / shortest)));
  for (std::size_t repetition = 0; repetition < (quick ? 3U : 9U); ++repetition) {
    std::vector<double> sums(contenders.size());
    for (int round = 0; round < rounds; ++round) {
      run_once(contenders, measured, repetition);
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] += measured.times[i].back();
        measured.times[i].pop_back();
      }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) measured.times[i].push_back(sums[i] / rounds);
  }
  return measured;
}

[[nodiscard]] double mega_rays(const Measured& measured, std::size_t contender) {
  return 1e-6 * double(measured.set.rays.size()) / median(measured.times[contender]);
}

/// How many answers of each contender the judge finds wrong. It is asked where contenders disagree.
void count_wrong(const Contenders& contenders, const Measured& measured, const Judge& judge,
                 std::vector<std::size_t>& wrong) {
  const auto& [set, times, answers] = measured;
  const auto same = [&](const Hit<float>& a, const Hit<float>& b) {
    if (a.primitive != b.primitive) return false;
    return set.question == Question::Occluded || a.t == b.t || std::abs(a.t - b.t) <= 1e-5F * std::abs(a.t);
  };
  for (std::size_t i = 0; i < set.rays.size(); ++i) {
    const auto agrees = [&](const Answers& other) { return same(answers[0][i], other[i]); };
    if (std::all_of(answers.begin(), answers.end(), agrees)) continue;
    for (std::size_t who = 0; who < contenders.size(); ++who) {
      const Hit<float>& hit = answers[who][i];
      const bool met = hit.primitive != none<std::uint32_t>;
      const bool right =
          set.question == Question::Closest
              ? judge.is_right(set.rays[i], met ? std::optional(hit) : std::nullopt)
              : judge.is_right(set.rays[i], met, met ? contenders[who].witness(set.rays[i]) : std::nullopt);
      wrong[who] += right ? 0U : 1U;
    }
  }
}

/// The fastest of ours over the fastest of theirs; theirs of the same kind of edges, ours of it or of a stricter one.
void print_best(const std::string& mesh, const Contenders& contenders, const Measured& measured, Edges edges) {
  std::size_t best[2] = {contenders.size(), contenders.size()};
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    const bool ours = is_ours(contenders[i]);
    const bool allowed = contenders[i].edges == edges || (ours && contenders[i].edges == Edges::Watertight);
    std::size_t& leader = best[ours ? 0 : 1];
    if (allowed && (leader == contenders.size() || mega_rays(measured, i) > mega_rays(measured, leader))) leader = i;
  }
  if (best[0] == contenders.size() || best[1] == contenders.size()) return;
  std::printf("best  %-10s %-8s %-10s %5.2f  %s over %s\n", mesh.c_str(), measured.set.name.c_str(),
              edges == Edges::Watertight ? "watertight" : "any",
              median_ratio(measured.times[best[1]], measured.times[best[0]]), contenders[best[0]].name.c_str(),
              contenders[best[1]].name.c_str());
}

void print_rates(const std::string& mesh, const Contenders& contenders, const std::vector<Measured>& all) {
  std::printf("%-24s", "million rays a second");
  for (const Measured& measured : all) std::printf("%9s", measured.set.name.c_str());
  for (std::size_t i = 0; i < contenders.size(); ++i) {
    std::printf("\n%-7s%-17s", is_ours(contenders[i]) ? "glint" : "embree", contenders[i].name.c_str());
    for (const Measured& measured : all) std::printf("%9.2f", mega_rays(measured, i));
  }
  std::printf("\n");
  for (const Measured& measured : all) {
    for (std::size_t ours = 0; ours < contenders.size(); ++ours) {
      for (std::size_t theirs = 0; theirs < contenders.size(); ++theirs) {
        if (!is_ours(contenders[ours]) || is_ours(contenders[theirs])) continue;
        std::printf("RATIO %s %s %s %s %.3f\n", mesh.c_str(), measured.set.name.c_str(), contenders[ours].name.c_str(),
                    contenders[theirs].name.c_str(), median_ratio(measured.times[theirs], measured.times[ours]));
      }
    }
  }
}

void print_bytes(const NamedMesh& mesh, const EmbreeDevice& device, const Contenders& contenders) {
  const double triangles = double(mesh.buffers.indices.size() / 3);
  for (const Contender& ours : contenders) {
    if (!is_ours(ours)) continue;
    const auto theirs = EmbreeCaster(device, mesh.buffers, settings_named(ours.like)).bytes();
    std::printf("BYTES %s %s %.1f %.1f\n", mesh.name.c_str(), ours.name.c_str(), double(ours.bytes) / triangles,
                double(theirs) / triangles);
  }
}

/// Everything that can be named after --only.
struct Names {
  std::vector<std::string> meshes;
  std::vector<std::string> measures{"primary", "diffuse", "ao", "shadow", "build"};
  std::vector<std::string> ours;
  std::vector<std::string> theirs;
};

struct Peers {
  PeerOptions options;
  Names names;
  std::size_t wrong = 0;
  std::vector<std::string> summary;

  [[nodiscard]] Contenders contenders(const NamedMesh& mesh, const EmbreeDevice& device) const {
    Contenders all;
    const TbbExecutor executor(options.threads);
    const auto add = [&](const auto& ours) {
      if (!is_wanted(options, names.ours, ours.name)) return;
      using Caster = decltype(ours.make(mesh.buffers, executor));
      all.push_back(contender<Caster>(ours.name, ours.edges, ours.like,
                                      std::make_shared<const Caster>(ours.make(mesh.buffers, executor))));
    };
    std::apply([&](const auto&... ours) { (add(ours), ...); }, our_layouts());
    for (const Theirs& theirs : their_settings()) {
      if (!is_wanted(options, names.theirs, theirs.name)) continue;
      all.push_back(contender<EmbreeCaster>(
          theirs.name, theirs.edges, "", std::make_shared<const EmbreeCaster>(device, mesh.buffers, theirs.settings)));
    }
    return all;
  }

  void measure_rays(const NamedMesh& mesh) {
    const EmbreeDevice device(options.threads);
    const Contenders all = contenders(mesh, device);
    print_bytes(mesh, device, all);
    const Bvh caster(view(mesh.buffers));
    const Viewpoint from = mesh.viewpoint.value_or(look_at_all(caster.bounds()));
    const Judge judge(mesh.buffers);
    std::vector<Measured> measured;
    std::vector<std::size_t> wrong_answers(all.size());
    for (RaySet& set : ray_sets(caster, from, std::size_t(1) << (options.quick ? 12 : 18))) {
      if (!is_wanted(options, names.measures, set.name)) continue;
      measured.push_back(run(all, std::move(set), options.quick));
      count_wrong(all, measured.back(), judge, wrong_answers);
      measured.back().answers.clear();
      measured.back().set.rays.shrink_to_fit();
    }
    print_rates(mesh.name, all, measured);
    for (const Measured& one : measured) {
      print_best(mesh.name, all, one, Edges::Watertight);
      print_best(mesh.name, all, one, Edges::Fast);
    }
    report_wrong(mesh.name, all, wrong_answers);
  }

  void report_wrong(const std::string& mesh, const Contenders& all, const std::vector<std::size_t>& answers) {
    std::size_t of_ours = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (is_ours(all[i])) of_ours += answers[i];
      if (answers[i] != 0)
        std::printf("wrong answers of %s %s: %zu\n", is_ours(all[i]) ? "glint" : "embree", all[i].name.c_str(),
                    answers[i]);
    }
    std::printf("WRONG %s %zu\n", mesh.c_str(), of_ours);
    wrong += of_ours;
  }

  /// Ours and theirs in turns, from the mesh as it lies in memory to a tree that takes rays.
  template <typename Ours, typename E>
  void measure_build(const NamedMesh& mesh, const Ours& ours, const EmbreeDevice& device, const E& executor,
                     int threads) {
    const clockid_t clock = threads == 1 ? CLOCK_PROCESS_CPUTIME_ID : CLOCK_MONOTONIC;
    const EmbreeSettings settings = settings_named(ours.like);
    std::vector<double> our_times;
    std::vector<double> their_times;
    const auto build_ours = [&] {
      using Caster = decltype(ours.make(mesh.buffers, executor));
      std::unique_ptr<Caster> made;
      our_times.push_back(
          seconds_of(clock, [&] { made = std::make_unique<Caster>(ours.make(mesh.buffers, executor)); }));
    };
    const auto build_theirs = [&] {
      std::unique_ptr<EmbreeCaster> made;
      their_times.push_back(
          seconds_of(clock, [&] { made = std::make_unique<EmbreeCaster>(device, mesh.buffers, settings); }));
    };
    build_theirs();
    build_ours();
    const int repetitions = options.quick ? 1 : our_times[0] + their_times[0] > 1 ? 5 : 9;
    our_times.clear();
    their_times.clear();
    for (int i = 0; i < repetitions; ++i) {
      if (i % 2 == 0) build_ours();
      build_theirs();
      if (i % 2 != 0) build_ours();
    }
    std::printf("build %-10s %d threads  %8.1f ms, embree %-6s %8.1f ms\n", ours.name.c_str(), threads,
                1e3 * median(our_times), ours.like.c_str(), 1e3 * median(their_times));
    std::printf("BUILD %s %s %d %.3f\n", mesh.name.c_str(), ours.name.c_str(), threads,
                median_ratio(their_times, our_times));
  }

  template <typename E>
  void measure_builds(const NamedMesh& mesh, const E& executor, int threads) {
    const EmbreeDevice device(threads);
    std::apply(
        [&](const auto&... ours) {
          const auto measure = [&](const auto& one) {
            if (is_wanted(options, names.ours, one.name)) measure_build(mesh, one, device, executor, threads);
          };
          (measure(ours), ...);
        },
        our_builds());
  }

  void measure(NamedMesh mesh) {
    mesh.buffers.positions.push_back(Vec3<float>{0.0F});  // nobody's: Embree reads beyond the last
    std::printf("\n%s: %zu triangles\n", mesh.name.c_str(), mesh.buffers.indices.size() / 3);
    const auto wanted = [&](const char* measure) { return is_wanted(options, names.measures, measure); };
    if (wanted("primary") || wanted("diffuse") || wanted("ao") || wanted("shadow")) measure_rays(mesh);
    if (wanted("build")) {
      measure_builds(mesh, Serial{}, 1);
      if (options.threads > 1) measure_builds(mesh, TbbExecutor(options.threads), options.threads);
    }
    std::fflush(stdout);
  }
};

/// The names there are, of which --only may choose.
[[nodiscard]] Names all_names(const PeerOptions& options) {
  Names names;
  for (const std::string& file : options.mesh_files) names.meshes.push_back(mesh_name(file));
  if (options.mesh_files.empty()) {
    for (const MeshMaker& maker : mesh_makers()) names.meshes.push_back(maker.name);
    for (const std::string& file : files_beside_the_source()) names.meshes.push_back(mesh_name(file));
  }
  const auto add_ours = [&](const auto&... ours) { (names.ours.push_back(ours.name), ...); };
  std::apply(add_ours, our_layouts());
  std::apply(add_ours, our_builds());
  for (const Theirs& theirs : their_settings()) names.theirs.push_back(theirs.name);
  for (const std::string& name : options.only) {
    const auto has = [&](const std::vector<std::string>& kind) {
      return std::find(kind.begin(), kind.end(), name) != kind.end();
    };
    if (has(names.meshes) || has(names.measures) || has(names.ours) || has(names.theirs)) continue;
    std::string known;
    for (const auto* kind : {&names.meshes, &names.measures, &names.ours, &names.theirs})
      for (const std::string& one : *kind) known += ' ' + one;
    throw std::runtime_error("--only does not know '" + name + "'; there are:" + known);
  }
  return names;
}

void measure_all(Peers& peers) {
  std::vector<std::string> files = peers.options.mesh_files;
  for (const std::string& file : files) {
    if (std::error_code error; !std::filesystem::is_regular_file(file, error))
      throw std::runtime_error("there is no file '" + file + "'");
  }
  const bool generated = files.empty();
  if (generated) files = files_beside_the_source();
  for (const std::string& file : files) {
    if (is_wanted(peers.options, peers.names.meshes, mesh_name(file)))
      peers.measure({mesh_name(file), load_mesh(file)});
  }
  if (!generated) return;
  for (const MeshMaker& maker : mesh_makers()) {
    if (is_wanted(peers.options, peers.names.meshes, maker.name))
      peers.measure(maker.make(std::min(maker.triangles, peers.options.max_triangles)));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  Peers peers{parse_peer_options({argv + 1, argv + argc}), {}, 0, {}};
  if (peers.options.help) {
    std::fputs(peer_help.data(), stdout);
    return EXIT_SUCCESS;
  }
  peers.names = all_names(peers.options);
  measure_all(peers);
  return peers.wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_peers: %s\n", error.what());
  return EXIT_FAILURE;
}

// SPDX-License-Identifier: MIT
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <glint/core/executor.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/triangle_mesh.hpp>

#include <peers/contenders.hpp>
#include <peers/embree.hpp>
#include <peers/judge.hpp>
#include <peers/mesh_list.hpp>
#include <peers/options.hpp>
#include <peers/race.hpp>
#include <peers/report.hpp>
#include <support/named_mesh.hpp>
#include <support/ray_sets.hpp>
#include <support/timing.hpp>

namespace {

using namespace glint;
using namespace glint::bench;

/// What can be named after --only, beside meshes.
struct Names {
  std::vector<std::string> measures{"primary", "diffuse", "ao", "shadow", "build"};
  std::vector<std::string> ours;
  std::vector<std::string> theirs;
};

struct Peers {
  PeerOptions options;
  Names names;
  std::size_t wrong = 0;

  [[nodiscard]] Contenders contenders(const NamedMesh& mesh, const EmbreeDevice& device) const {
    Contenders all;
    const TbbExecutor executor(options.threads);
    const auto add = [&](const auto& ours) {
      if (!is_wanted(options, names.ours, ours.name)) return;
      all.push_back(contender(ours, mesh.buffers, executor));
    };
    std::apply([&](const auto&... ours) { (add(ours), ...); }, our_layouts());
    for (const Theirs& theirs : their_settings()) {
      if (is_wanted(options, names.theirs, theirs.name)) all.push_back(contender(theirs, mesh.buffers, device));
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
      for (const Call call : {Call::Single, Call::Batch}) {
        print_best(mesh.name, all, one, call, Edges::Watertight);
        print_best(mesh.name, all, one, call, Edges::Fast);
      }
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
    // Workers look for more to do where they last worked, before they come to whoever is next.
    const auto part = [&] { std::this_thread::sleep_for(std::chrono::milliseconds(threads == 1 ? 0 : 10)); };
    const auto build_ours = [&] {
      part();
      using Caster = decltype(ours.make(mesh.buffers, executor));
      std::unique_ptr<Caster> made;
      our_times.push_back(
          seconds_of(clock, [&] { made = std::make_unique<Caster>(ours.make(mesh.buffers, executor)); }));
    };
    const auto build_theirs = [&] {
      part();
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

  void measure(const NamedMesh& mesh) {
    std::printf("\n%s: %zu triangles\n", mesh.name.c_str(), mesh.buffers.indices.size() / 3);
    const auto wanted = [&](const char* measure) { return is_wanted(options, names.measures, measure); };
    if (wanted("primary") || wanted("diffuse") || wanted("ao") || wanted("shadow")) measure_rays(mesh);
    if (wanted("build")) {
      measure_builds(mesh, Serial{}, 1);
      if (options.threads > 1) measure_builds(mesh, TbbExecutor(options.threads), options.threads);
    }
  }
};

/// The names there are, of which --only may choose.
[[nodiscard]] Names all_names(const PeerOptions& options) {
  Names names;
  const auto add_ours = [&](const auto&... ours) { (names.ours.push_back(ours.name), ...); };
  std::apply(add_ours, our_layouts());
  std::apply(add_ours, our_builds());
  for (const Theirs& theirs : their_settings()) names.theirs.push_back(theirs.name);
  check_names(options, {mesh_names(options), names.measures, names.ours, names.theirs});
  return names;
}

}  // namespace

int main(int argc, char** argv) try {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines as they come, also into files
  Peers peers{parse_peer_options({argv + 1, argv + argc}, peers_help), {}, 0};
  if (peers.options.help) {
    std::fputs(peers_help.data(), stdout);
    return EXIT_SUCCESS;
  }
  peers.names = all_names(peers.options);
  for_each_mesh(peers.options, [&](const NamedMesh& mesh) { peers.measure(mesh); });
  return peers.wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_peers: %s\n", error.what());
  return EXIT_FAILURE;
}

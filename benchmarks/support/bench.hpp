// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdlib>
#include <exception>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>

#include <glint/testing/random_scenes.hpp>

#include <support/named_mesh.hpp>

/// What the benchmarks have in common: options, meshes, and failing when an answer is wrong.
namespace glint::bench {

struct Options {
  bool quick = false;                     ///< --quick: small meshes, each benchmark once
  std::size_t max_triangles = 1'000'000;  ///< --max-triangles N: of generated meshes; 10000000 for the largest
  std::vector<std::string> mesh_files;    ///< --mesh FILE, any number of times
};

/// Takes our own options out of the command line; the others are Google Benchmark's.
[[nodiscard]] inline Options parse_options(std::vector<char*>& arguments) {
  Options options;
  std::vector<char*> others;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view argument = arguments[i];
    const bool has_value = i + 1 < arguments.size();
    if (argument == "--quick")
      options.quick = true;
    else if (argument == "--mesh" && has_value)
      options.mesh_files.emplace_back(arguments[++i]);
    else if (argument == "--max-triangles" && has_value)
      options.max_triangles = std::strtoull(arguments[++i], nullptr, 10);
    else
      others.push_back(arguments[i]);
  }
  arguments = std::move(others);
  if (options.quick) options.max_triangles = 10'000;
  return options;
}

/// Generated meshes of 10³ triangles and up, and those given as files.
[[nodiscard]] inline std::vector<NamedMesh> meshes(const Options& options) {
  std::vector<NamedMesh> all;
  for (std::size_t n = 1000; n <= options.max_triangles; n *= 10) {
    all.push_back({"blob/" + std::to_string(n), testing::scanned_blob<float>(n, 1)});
    all.push_back({"soup/" + std::to_string(n), testing::triangle_soup<float>(n, 2)});
  }
  for (const std::string& file : options.mesh_files)
    all.push_back({file.substr(file.find_last_of('/') + 1), load_mesh(file)});
  return all;
}

/// Whether any benchmark gave a wrong answer.
[[nodiscard]] inline bool& any_wrong() {
  static bool wrong = false;
  return wrong;
}

/// Fails the benchmark, and the program, unless the answer is right: a fast wrong answer is none.
inline bool verify(benchmark::State& state, bool right, const char* what) {
  if (right) return true;
  any_wrong() = true;
  state.SkipWithError(what);
  return false;
}

/// The body of main: registers, runs, and says whether all answers were right.
inline int run(int argc, char** argv, const std::function<void(const Options&)>& register_all) try {
  std::vector<char*> arguments(argv, argv + argc);
  const Options options = parse_options(arguments);
  std::string once = "--benchmark_min_time=0.001";
  if (options.quick) arguments.insert(arguments.begin() + 1, once.data());
  int count = int(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return EXIT_FAILURE;
  register_all(options);
  benchmark::RunSpecifiedBenchmarks();
  return any_wrong() ? EXIT_FAILURE : EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return EXIT_FAILURE;
}

}  // namespace glint::bench

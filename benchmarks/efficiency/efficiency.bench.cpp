// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include <glint/color/compare.hpp>
#include <glint/color/image.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/film/film.hpp>
#include <glint/io/image.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_json.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/render/render.hpp>

#include <support/timing.hpp>

/// Noise against time: relMSE against a converged image, and what a second of rendering buys.

namespace {

using namespace glint;
namespace fs = std::filesystem;

constexpr std::string_view help =
    R"(bench_efficiency [SCENE.json]... [--threads N] [--spp N] [--reference-spp N] [--references DIR] [--quick]

Renders scenes by path tracing to 12 segments, and compares them with converged images of our own.

  SCENE.json          scenes; without, a Cornell box, one with glass, and what is found beside the source tree
  --threads N         2 unless given
  --spp N             samples a pixel, 64 unless given
  --reference-spp N   of the converged image, 2048 unless given; its noise is counted as error, one part in 32
  --references DIR    keep converged images there, and use those that are
  --quick             small and noisy: whether it works
  --help

A line to be read by programs for each scene:
  EFFICIENCY scene Msamples/s relMSE 1/(relMSE·s)
)";

struct EfficiencyOptions {
  bool help = false;
  bool quick = false;
  int threads = 2;
  int samples = 64;
  int reference_samples = 2048;
  std::string references;
  std::vector<std::string> scenes;
};

/// A scene, and what is changed in it before it is read.
struct Task {
  std::string name;
  fs::path file;
  nlohmann::json changes = nlohmann::json::object();
};

[[nodiscard]] int positive(const std::string& option, const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1 || value > 1 << 24)
    throw std::runtime_error(option + ": found '" + text + "', expected a number from 1 to 16777216");
  return value;
}

[[nodiscard]] EfficiencyOptions parse(const std::vector<std::string>& arguments) {
  EfficiencyOptions options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& option = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw std::runtime_error(option + " takes a value");
      return arguments[++i];
    };
    if (option == "--help")
      options.help = true;
    else if (option == "--quick")
      options.quick = true;
    else if (option == "--threads")
      options.threads = positive(option, value());
    else if (option == "--spp")
      options.samples = positive(option, value());
    else if (option == "--reference-spp")
      options.reference_samples = positive(option, value());
    else if (option == "--references")
      options.references = value();
    else if (option.starts_with("--"))
      throw std::runtime_error("unknown option '" + option + "'; --help shows those there are");
    else
      options.scenes.push_back(option);
  }
  return options;
}

/// The Cornell box of other renderers' comparisons with a glass sphere in place of its boxes.
[[nodiscard]] nlohmann::json glass_sphere(const fs::path& box) {
  std::ifstream file(box);
  nlohmann::json objects = nlohmann::json::parse(file).at("objects");
  objects.erase(objects.end() - 2, objects.end());
  objects.push_back({{"type", "sphere"}, {"center", {0.0, 0.55, 0.1}}, {"radius", 0.45}, {"material_name", "glass"}});
  return {{"objects", objects}, {"materials", {{"glass", {{"type", "glass"}, {"eta", 1.5}}}}}};
}

[[nodiscard]] std::vector<Task> tasks(const EfficiencyOptions& options) {
  std::vector<Task> all;
  for (const std::string& scene : options.scenes) all.push_back({fs::path(scene).stem().string(), scene});
  if (!all.empty()) return all;
  const fs::path source = GLINT_SOURCE_DIR;
  for (const char* name : {"cornell_box", "cornell_box_glass"})
    all.push_back({name, source / "examples" / "scenes" / (std::string(name) + ".json")});
  const fs::path shared = source / ".." / "shared" / "scenes" / "oracles";
  if (std::error_code error; options.quick || !fs::exists(shared / "cbox.json", error)) return all;
  all.push_back({"cbox", shared / "cbox.json"});
  all.push_back({"bunny", shared / "bunny.json"});
  all.push_back({"glass", shared / "cbox.json", glass_sphere(shared / "cbox.json")});
  return all;
}

struct Rendering {
  Image image;
  double seconds = 0;
  double samples = 0;
};

[[nodiscard]] Rendering render_once(const SceneFile& file, const TbbExecutor& executor, std::uint64_t seed,
                                    int samples) {
  const auto scene = scene_of(file, executor);
  Film<SceneFilter> film(file.film.resolution, file.film.filter);
  const Path integrator{.max_depth = 12};
  const auto sequence = sequence_of({.kind = file.sampler.kind, .seed = seed}, samples);
  const auto report = render(scene, file.camera, integrator, film, {.samples = samples}, executor, sequence);
  return {film.develop(executor), report.seconds, double(report.samples)};
}

/// The converged image: kept, and looked for, where the user says so.
[[nodiscard]] Image reference_of(const Task& task, const SceneFile& file, const EfficiencyOptions& options,
                                 const TbbExecutor& executor) {
  const fs::path kept =
      options.references.empty()
          ? fs::path()
          : fs::path(options.references) / (task.name + '-' + std::to_string(options.reference_samples) + ".exr");
  std::error_code error;
  if (!kept.empty() && fs::exists(kept, error)) {
    Image image = read_image(kept);
    if (image.size() == file.film.resolution) return image;
  }
  Image image = render_once(file, executor, 1'000'003, options.reference_samples).image;
  if (!kept.empty()) {
    fs::create_directories(kept.parent_path());
    write_image(image, kept);
  }
  return image;
}

void measure(const Task& task, const EfficiencyOptions& options, const TbbExecutor& executor) {
  SceneReadOptions reading;
  reading.overrides.push_back(task.changes.dump());
  SceneFile file = read_scene(task.file, reading);
  if (options.quick) file.film.resolution = {48, 48};
  const Image reference = reference_of(task, file, options, executor);
  std::vector<double> errors;
  std::vector<double> seconds;
  double samples = 0;
  for (std::uint64_t seed = 1; seed <= (options.quick ? 1U : 3U); ++seed) {
    const Rendering one = render_once(file, executor, seed, options.samples);
    const auto difference = compare(one.image, reference);
    if (!difference || !(std::abs(difference->mean_ratio - 1) < (options.quick ? 0.1 : 0.01)))
      throw std::runtime_error(task.name + ": the mean is not that of the converged image");
    errors.push_back(difference->relmse);
    seconds.push_back(one.seconds);
    samples = one.samples;
  }
  const double relmse = bench::median(errors);
  const double time = bench::median(seconds);
  std::printf("EFFICIENCY %s %.2f %.3g %.4g\n", task.name.c_str(), samples / time * 1e-6, relmse, 1 / (relmse * time));
}

}  // namespace

int main(int argc, char** argv) try {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines as they come, also into files
  EfficiencyOptions options = parse({argv + 1, argv + argc});
  if (options.help) {
    std::fputs(help.data(), stdout);
    return EXIT_SUCCESS;
  }
  if (options.quick) options.reference_samples = std::min(options.reference_samples, 256);
  const TbbExecutor executor(options.threads);
  for (const Task& task : tasks(options)) measure(task, options, executor);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_efficiency: %s\n", error.what());
  return EXIT_FAILURE;
}

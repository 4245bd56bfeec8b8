// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
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
#include <glint/render/render.hpp>

#include <efficiency/options.hpp>
#include <support/timing.hpp>

/// Noise against time: relMSE against converged images, and what a second of rendering buys.

namespace {

using namespace glint;
using namespace glint::bench;
namespace fs = std::filesystem;

/// A scene, what is changed in it before it is read, and how its light is found.
struct Task {
  std::string name;
  fs::path file;
  nlohmann::json changes = nlohmann::json::object();
  std::vector<Transport> transports{Transport::Path};  ///< the last one makes the references
};

/// The Cornell box of other renderers' comparisons with a glass sphere in place of its boxes.
[[nodiscard]] nlohmann::json glass_sphere(const fs::path& box) {
  std::ifstream file(box);
  nlohmann::json objects = nlohmann::json::parse(file).at("objects");
  objects.erase(objects.end() - 2, objects.end());
  objects.push_back({{"type", "sphere"}, {"center", {0.0, 0.55, 0.1}}, {"radius", 0.45}, {"material_name", "glass"}});
  return {{"objects", objects}, {"materials", {{"glass", {{"type", "glass"}, {"eta", 1.5}}}}}};
}

/// The scenes that have names.
[[nodiscard]] std::vector<Task> named_tasks() {
  const std::vector both{Transport::Path, Transport::Bdpt};
  const fs::path source = GLINT_SOURCE_DIR;
  const fs::path own = source / "examples" / "scenes";
  const fs::path shared = source / ".." / "shared" / "scenes" / "oracles";
  std::vector<Task> all{{.name = "cornell_box", .file = own / "cornell_box.json"},
                        {.name = "cornell_box_glass", .file = own / "cornell_box_glass.json", .transports = both}};
  if (std::error_code error; !fs::exists(shared / "cbox.json", error)) {
    std::fputs("cbox, bunny, glass: left out, as they are not beside the source tree\n", stderr);
    return all;
  }
  all.push_back({.name = "cbox", .file = shared / "cbox.json"});
  all.push_back({.name = "bunny", .file = shared / "bunny.json"});
  all.push_back({.name = "glass",
                 .file = shared / "cbox.json",
                 .changes = glass_sphere(shared / "cbox.json"),
                 .transports = both});
  return all;
}

[[nodiscard]] std::vector<Task> tasks(const EfficiencyOptions& options) {
  std::vector<Task> known = named_tasks();
  if (options.scenes.empty()) return known;
  std::vector<Task> result;
  for (const std::string& scene : options.scenes) {
    const auto found = std::find_if(known.begin(), known.end(), [&](const Task& task) { return task.name == scene; });
    result.push_back(found != known.end() ? *found : Task{.name = fs::path(scene).stem().string(), .file = scene});
  }
  return result;
}

struct Rendering {
  Image image;
  double wall_seconds = 0;
  double cpu_seconds = 0;  ///< of all threads, over their number
};

/// A scene ready to be rendered in several ways.
struct Subject {
  const SceneFile& file;
  const LoadedScene& scene;
  const TbbExecutor& executor;
  float roulette;

  /// Of the whole image.
  [[nodiscard]] double samples(int of_pixel) const {
    return double(file.film.resolution.x) * double(file.film.resolution.y) * of_pixel;
  }

  [[nodiscard]] Rendering render(Transport transport, const SamplerSettings& sampler, int samples) const {
    return transport == Transport::Path ? render(Path{}, sampler, samples) : render(Bdpt{}, sampler, samples);
  }

 private:
  template <typename I>
  [[nodiscard]] Rendering render(I integrator, const SamplerSettings& sampler, int samples) const {
    integrator.max_depth = 12;
    if (roulette >= 0) integrator.roulette_below = roulette;
    Film<SceneFilter> film(file.film.resolution, file.film.filter);
    const auto sequence = sequence_of(sampler, samples);
    const double begin = seconds(CLOCK_PROCESS_CPUTIME_ID);
    const auto report = glint::render(scene, file.camera, integrator, film, {.samples = samples}, executor, sequence);
    const double cpu_seconds = (seconds(CLOCK_PROCESS_CPUTIME_ID) - begin) / executor.concurrency();
    return {film.develop(executor), report.seconds, cpu_seconds};
  }
};

using References = std::array<Image, 2>;

/// The converged images: kept, and looked for, where the user says so.
[[nodiscard]] References references_of(const Task& task, const Subject& subject, const EfficiencyOptions& options) {
  References result;
  for (std::uint64_t i = 0; i < result.size(); ++i) {
    const std::string name = task.name + '-' + std::to_string(options.reference_samples) + "-of-" +
                             std::to_string(subject.file.film.resolution.x) + '-' + std::to_string(i) + ".exr";
    const fs::path kept = options.references.empty() ? fs::path() : fs::path(options.references) / name;
    std::error_code error;
    if (!kept.empty() && fs::exists(kept, error)) {
      result[i] = read_image(kept);
      continue;
    }
    constexpr std::uint64_t first_seed = 1'000'003;  // far from those that are measured
    result[i] = subject.render(task.transports.back(), {.seed = first_seed + i}, options.reference_samples).image;
    if (kept.empty()) continue;
    fs::create_directories(kept.parent_path());
    write_image(result[i], kept);
  }
  return result;
}

/// The mean over pixels and channels of (I − R₁) (I − R₂) / (R² + 0.01), R the mean of the two.
[[nodiscard]] double relmse(const Image& image, const References& references) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels().size(); ++i) {
    const auto add = [&](double x, double first, double second) {
      const double mean = (first + second) / 2;
      sum += (x - first) * (x - second) / (mean * mean + 0.01);
    };
    const Rgb& x = image.pixels()[i];
    const Rgb& first = references[0].pixels()[i];
    const Rgb& second = references[1].pixels()[i];
    add(double(x.r), double(first.r), double(second.r));
    add(double(x.g), double(first.g), double(second.g));
    add(double(x.b), double(first.b), double(second.b));
  }
  return sum / (3 * double(image.pixels().size()));
}

/// Renders with several seeds, and prints the medians. Errors: the image is not that of the references.
void measure(const Task& task, const Subject& subject, const References& references, Transport transport,
             SamplerKind sampler, const EfficiencyOptions& options) {
  std::vector<double> errors;
  std::vector<double> wall;
  std::vector<double> cpu;
  for (int seed = 1; seed <= options.repetitions; ++seed) {
    const SamplerSettings settings{.kind = sampler, .seed = std::uint64_t(seed)};
    const Rendering rendering = subject.render(transport, settings, options.samples);
    const auto difference = compare(rendering.image, references[0]);
    if (!difference || !(std::abs(difference->mean_ratio - 1) < (options.quick ? 0.1 : 0.01)))
      throw std::runtime_error(task.name + ": the mean is not that of the converged image");
    errors.push_back(relmse(rendering.image, references));
    wall.push_back(rendering.wall_seconds);
    cpu.push_back(rendering.cpu_seconds);
  }
  const double error = median(errors);
  const double samples = subject.samples(options.samples);
  std::printf("EFFICIENCY %s %s %s %.4g  %.2f %.4g  %.2f %.4g\n", task.name.c_str(),
              name_of(transport, transports).c_str(), name_of(sampler, samplers).c_str(), error,
              samples / median(wall) * 1e-6, 1 / (error * median(wall)), samples / median(cpu) * 1e-6,
              1 / (error * median(cpu)));
}

void measure(const Task& task, const EfficiencyOptions& options, const TbbExecutor& executor) {
  SceneReadOptions reading;
  reading.overrides.push_back(task.changes.dump());
  SceneFile file = read_scene(task.file, reading);
  if (options.resolution > 0) file.film.resolution = Vec2i(options.resolution);
  const LoadedScene scene = scene_of(file, executor);
  const Subject subject{file, scene, executor, options.roulette};
  const References references = references_of(task, subject, options);
  for (const Transport transport : options.transports.empty() ? task.transports : options.transports) {
    for (const SamplerKind sampler : options.samplers) {
      measure(task, subject, references, transport, sampler, options);
    }
  }
}

}  // namespace

int main(int argc, char** argv) try {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines as they come, also into files
  const EfficiencyOptions options = parse_efficiency_options({argv + 1, argv + argc});
  if (options.help) {
    std::fputs(efficiency_help.data(), stdout);
    return EXIT_SUCCESS;
  }
  const TbbExecutor executor(options.threads);
  for (const Task& task : tasks(options)) measure(task, options, executor);
  return EXIT_SUCCESS;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_efficiency: %s\n", error.what());
  return EXIT_FAILURE;
}

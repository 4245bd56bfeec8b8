// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include <glint/core/tbb_executor.hpp>
#include <glint/film/film.hpp>
#include <glint/io/image.hpp>
#include <glint/io/scene_file.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/render/options.hpp>
#include <glint/render/report.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "read_scene.hpp"
#include "render_job.hpp"

namespace {

constexpr int interrupted = 130;

/// The files to write: those asked for, or SCENE.exr here; and a PNG beside an EXR that has none.
std::vector<std::filesystem::path> output_files(const RenderArguments& arguments) {
  std::vector<std::filesystem::path> result = arguments.outputs;
  if (result.empty()) result.push_back(arguments.scene.path.filename().replace_extension(".exr"));
  const auto is_png = [](const auto& path) { return glint::detail::lower_case_extension(path) == ".png"; };
  if (!arguments.no_png && std::none_of(result.begin(), result.end(), is_png)) {
    const auto exr = std::find_if(result.begin(), result.end(),
                                  [](const auto& p) { return glint::detail::lower_case_extension(p) == ".exr"; });
    if (exr != result.end()) result.push_back(std::filesystem::path(*exr).replace_extension(".png"));
  }
  return result;
}

/// Finds out before the long work whether its result can be written.
void require_writable(const std::filesystem::path& output, const glint::SceneFile& scene) {
  for (const std::filesystem::path& input : scene.inputs) require_other_file(output, input);
  require_writable_image(output);
}

glint::SceneFile scene_to_render(const RenderArguments& arguments) {
  glint::SceneFile scene = read_scene(arguments.scene);
  if (arguments.samples) scene.integrator.samples = *arguments.samples;
  if (arguments.seed) scene.sampler.seed = *arguments.seed;
  if (arguments.tone) scene.film.tone = *arguments.tone;
  if (arguments.resolution) scene.film.resolution = *arguments.resolution;
  return scene;
}

struct Rendering {
  glint::Image image;
  glint::RenderReport report;
};

Rendering render_scene(const glint::SceneFile& file, const RenderArguments& arguments,
                       const glint::TbbExecutor& executor, std::stop_token stop) {
  const auto scene = glint::any_scene_of(file, executor);
  glint::Film<glint::SceneFilter> film(file.film.resolution, file.film.filter);
  glint::RenderOptions options = glint::options_of(file);
  options.tile_size = arguments.tile_size;
  options.stop = std::move(stop);
  std::optional<ProgressDisplay> display;
  if (!arguments.quiet) {
    display.emplace();
    options.progress = [&](const glint::RenderProgress& progress) { (*display)(progress); };
  }
  const auto sequence = glint::sequence_of(file.sampler, file.integrator.samples);
  const auto report = file.integrator.integrator.visit([&](const auto& integrator) {
    return render({scene, file.camera, film, options, executor, sequence}, integrator);
  });
  return {film.develop(executor), report};
}

/// What a clamp takes is missing from the picture.
void tell_of_clamp(const glint::SceneFile& scene) {
  const auto* const path = scene.integrator.integrator.get_if<glint::Path>();
  if (path == nullptr || !path->clamp.is_on()) return;
  std::printf("light is clamped (direct %g, indirect %g): darker than without\n",
              static_cast<double>(path->clamp.direct), static_cast<double>(path->clamp.indirect));
}

void tell(const glint::SceneFile& scene, const RenderArguments& arguments, const glint::RenderReport& report,
          double other_seconds, const std::vector<std::filesystem::path>& outputs) {
  if (report.dropped != 0) {
    std::fprintf(stderr, "glint: warning: %llu samples were not finite and left out\n",
                 static_cast<unsigned long long>(report.dropped));
  }
  if (arguments.quiet) return;
  std::printf("%dx%d, %d samples a pixel, in %s (and %.2f s for reading and writing)\n", scene.film.resolution.x,
              scene.film.resolution.y, scene.integrator.samples, clock_time(report.seconds).c_str(), other_seconds);
  std::printf("%.2f M samples/s, %.2f M rays/s\n", static_cast<double>(report.samples) / report.seconds * 1e-6,
              static_cast<double>(report.rays) / report.seconds * 1e-6);
  tell_of_clamp(scene);
  for (const std::filesystem::path& output : outputs) {
    std::printf("wrote %s\n", std::filesystem::absolute(output).lexically_normal().string().c_str());
  }
}

void write(const glint::Image& image, const std::filesystem::path& output, const glint::PngOptions& options) {
  if (glint::detail::lower_case_extension(output) == ".png") {
    glint::write_png(image, output, options);
  } else {
    glint::write_image(image, output);
  }
}

}  // namespace

int render_file(const RenderArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const glint::SceneFile scene = scene_to_render(arguments);
  const auto outputs = output_files(arguments);
  for (const std::filesystem::path& output : outputs) require_writable(output, scene);
  const InterruptWatcher interrupt;  // before the executor, whose threads are to leave signals alone as well
  const auto executor = arguments.threads > 0 ? std::make_unique<glint::TbbExecutor>(arguments.threads)
                                              : std::make_unique<glint::TbbExecutor>();
  const Rendering rendering = render_scene(scene, arguments, *executor, interrupt.token());
  if (!rendering.report.complete) {
    std::fputs("glint: interrupted, nothing written\n", stderr);
    return interrupted;
  }
  const glint::PngOptions png{.exposure_stops = arguments.exposure, .curve = scene.film.tone};
  executor->parallel_for(outputs.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) write(rendering.image, outputs[i], png);
  });
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  tell(scene, arguments, rendering.report, std::max(0.0, seconds - rendering.report.seconds), outputs);
  return 0;
}

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include <glint/color/tone_curve.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/film/film.hpp>
#include <glint/io/image.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/io/scene_json.hpp>
#include <glint/render/options.hpp>

#include "commands.hpp"
#include "interrupt.hpp"
#include "output.hpp"
#include "progress.hpp"
#include "render_job.hpp"

namespace {

constexpr int interrupted = 130;

struct RenderArguments {
  std::filesystem::path scene;
  std::vector<std::filesystem::path> outputs;
  glint::SceneReadOptions reading;
  std::optional<int> samples;
  std::optional<std::uint64_t> seed;
  std::string resolution;
  int threads = 0;
  int tile_size = 32;
  float exposure = 0;
  std::optional<glint::ToneCurve> tone;
  bool no_png = false;
  bool quiet = false;
};

/// The files to write: those asked for, or SCENE.exr here; and a PNG beside an EXR that has none.
std::vector<std::filesystem::path> output_files(const RenderArguments& arguments) {
  std::vector<std::filesystem::path> result = arguments.outputs;
  if (result.empty()) result.push_back(arguments.scene.filename().replace_extension(".exr"));
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

std::optional<glint::Vec2i> parse_resolution(const std::string& text) {
  int width = 0;
  int height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%5dx%5d%c", &width, &height, &rest) != 2) return std::nullopt;
  if (width < 1 || height < 1 || width > 65536 || height > 65536) return std::nullopt;
  if (std::int64_t{width} * height > glint::max_image_pixels) return std::nullopt;
  return glint::Vec2i{width, height};
}

std::string resolution_problem(const std::string& text) {
  if (parse_resolution(text)) return {};
  return "found \"" + text + "\", expected WxH, each from 1 to 65536, and at most " +
         std::to_string(glint::max_image_pixels) + " pixels";
}

std::string seed_problem(const std::string& text) {
  std::uint64_t seed = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
  if (error == std::errc() && end == text.data() + text.size()) return {};
  return "found \"" + text + "\", expected an integer from 0 to 2^64 - 1";
}

std::string exposure_problem(const std::string& text) {
  float stops = 0;
  if (CLI::detail::lexical_cast(text, stops) && std::abs(stops) <= 64) return {};
  return "found \"" + text + "\", expected a number from -64 to 64";
}

std::optional<glint::ToneCurve> tone_of(const std::string& text) {
  for (const auto& [name, curve] : glint::tone_curves) {
    if (name == text) return curve;
  }
  return std::nullopt;
}

std::string tone_problem(const std::string& text) {
  if (tone_of(text)) return {};
  return "found \"" + text + "\", expected one of clip, filmic, hable, agx";
}

glint::SceneFile read_scene(const RenderArguments& arguments) {
  glint::SceneFile scene = glint::read_scene(arguments.scene, arguments.reading);
  if (arguments.samples) scene.integrator.samples = *arguments.samples;
  if (arguments.seed) scene.sampler.seed = *arguments.seed;
  if (arguments.tone) scene.film.tone = *arguments.tone;
  if (!arguments.resolution.empty()) scene.film.resolution = *parse_resolution(arguments.resolution);
  for (const std::string& warning : scene.warnings) std::fprintf(stderr, "glint: warning: %s\n", warning.c_str());
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

int render_file(const RenderArguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  const glint::SceneFile scene = read_scene(arguments);
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

void add_scene_options(CLI::App& command, const std::shared_ptr<RenderArguments>& a) {
  command.add_option("SCENE", a->scene, "The scene, JSON")->required()->option_text(" ");
  command.add_option("--spp", a->samples, "Samples a pixel")->check(CLI::Range(1, 1 << 24))->option_text("N");
  command.add_option("--seed", a->seed, "Another seed, other noise")
      ->check(CLI::Validator(seed_problem, ""))
      ->option_text("N");
  command.add_option("--resolution", a->resolution, "Image size, as 640x480")
      ->check(CLI::Validator(resolution_problem, ""))
      ->option_text("WxH");
  command
      .add_option("--integrator", a->reading.integrator,
                  "Replace the scene's integrator: path, direct, bdpt, light_tracer, random_walk, intersection_test, "
                  "ambient_occlusion, normals")
      ->option_text("NAME");
  command.add_option("--override", a->reading.overrides, "Merged into the scene; may be given several times")
      ->allow_extra_args(false)
      ->option_text("JSON");
  command.add_flag("--strict", a->reading.strict, "Unknown keys in the scene are errors");
}

void add_output_options(CLI::App& command, const std::shared_ptr<RenderArguments>& a) {
  command.add_option("-o,--output", a->outputs, "Write to this file: .exr, .hdr or .png; may be given several times")
      ->allow_extra_args(false)
      ->option_text("FILE");
  command.add_option("--exposure", a->exposure, "Stops by which the PNG is brightened, -64 to 64")
      ->check(CLI::Validator(exposure_problem, ""))
      ->option_text("STOPS");
  command
      .add_option_function<std::string>(
          "--tone", [a](const std::string& name) { a->tone = tone_of(name); },
          "The curve of the PNG: clip, filmic, hable, agx")
      ->check(CLI::Validator(tone_problem, ""))
      ->option_text("NAME");
  command.add_flag("--no-png", a->no_png, "Write no PNG beside the EXR");
}

}  // namespace

void add_render_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("render", "Render a JSON scene to EXR and PNG");
  const auto a = std::make_shared<RenderArguments>();
  add_scene_options(*command, a);
  add_output_options(*command, a);
  command->add_option("--threads", a->threads, "Threads; all cores by default")
      ->check(CLI::Range(1, 4096))
      ->option_text("N");
  command->add_option("--tile-size", a->tile_size, "Edge of a thread's share of the image, in pixels")
      ->check(CLI::Range(1, 65536))
      ->option_text("N");
  command->add_flag("--quiet", a->quiet, "Print nothing but warnings and errors");
  command->footer("Without -o, writes SCENE.exr and SCENE.png into the working directory.");
  command->callback([a, &exit_code] { exit_code = render_file(*a); });
}

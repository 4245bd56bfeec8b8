// SPDX-License-Identifier: MIT
#include "command_line.hpp"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <system_error>

#include <CLI/CLI.hpp>

#include <glint/color/tone_curve.hpp>
#include <glint/io/image_limits.hpp>
#include <glint/math/vec.hpp>
#include <glint/version.hpp>

#include "commands.hpp"

namespace {

constexpr int usage_error = 2;

std::string version_line() {
  return "glint " + std::to_string(glint::version.major) + "." + std::to_string(glint::version.minor) + "." +
         std::to_string(glint::version.patch);
}

/// One line, as all errors are.
std::string usage_line(const CLI::App* app, const CLI::Error& error) {
  std::string problem = error.what();
  if (const auto others = app->remaining(); app->get_subcommands().empty() && !others.empty()) {
    problem = "\"" + others.front() + "\" is not a subcommand, expected render, compare or info";
  }
  return "glint: " + problem + "; see glint --help\n";
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

void add_scene_options(CLI::App& command, const std::shared_ptr<RenderArguments>& a) {
  command.add_option("SCENE", a->scene.path, "The scene, JSON")->required()->option_text(" ");
  command.add_option("--spp", a->samples, "Samples a pixel")->check(CLI::Range(1, 1 << 24))->option_text("N");
  command.add_option("--seed", a->seed, "Another seed, other noise")
      ->check(CLI::Validator(seed_problem, ""))
      ->option_text("N");
  command
      .add_option_function<std::string>(
          "--resolution", [a](const std::string& size) { a->resolution = parse_resolution(size); },
          "Image size, as 640x480")
      ->check(CLI::Validator(resolution_problem, ""))
      ->option_text("WxH");
  command
      .add_option("--integrator", a->scene.integrator,
                  "Replace the scene's integrator: path, direct, bdpt, light_tracer, random_walk, intersection_test, "
                  "ambient_occlusion, normals")
      ->option_text("NAME");
  command.add_option("--override", a->scene.overrides, "Merged into the scene; may be given several times")
      ->allow_extra_args(false)
      ->option_text("JSON");
  command.add_flag("--strict", a->scene.strict, "Unknown keys in the scene are errors");
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

void add_compare_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("compare", "Measure how far an image is from a reference");
  const auto arguments = std::make_shared<CompareArguments>();
  command->add_option("A", arguments->image, "The image")->required()->option_text(" ");
  command->add_option("B", arguments->reference, "Its reference")->required()->option_text(" ");
  command->add_option("--max-rmse", arguments->max_rmse, "Fail above this root mean squared error")->option_text("X");
  command
      ->add_option("--max-relmse", arguments->max_relmse,
                   "Fail above this relative error: the mean of (A-B)^2 / (B^2 + 0.01)")
      ->option_text("X");
  command->add_option("--max-mean-error", arguments->max_mean_error, "Fail where |mean A / mean B - 1| is above this")
      ->option_text("X");
  command
      ->add_option("--max-share", arguments->max_share,
                   "Fail above this share of pixels with a channel off by more than 0.01")
      ->option_text("X");
  command->add_option("--difference", arguments->difference_image, "Write |A - B| as an image: .exr, .hdr or .png")
      ->option_text("FILE");
  command->callback([arguments, &exit_code] { exit_code = compare_images(*arguments); });
}

void add_info_command(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("info", "Say what is in a scene, a mesh or an image");
  const auto path = std::make_shared<std::filesystem::path>();
  command->add_option("FILE", *path, "A .json scene, an .obj mesh, or an image")->required()->option_text(" ");
  command->callback([path, &exit_code] { exit_code = tell_of_file(*path); });
}

}  // namespace

int run_command_line(int argc, char** argv) {
  CLI::App app("Renders JSON scenes, compares images, and says what is in a file.", "glint");
  app.set_version_flag("--version", version_line());
  app.require_subcommand(1);
  app.failure_message(usage_line);
  app.footer("Exit status: 0 done, 1 something failed or differs too much, 2 wrong usage, 130 interrupted.");
  int exit_code = 0;
  add_render_command(app, exit_code);
  add_compare_command(app, exit_code);
  add_info_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : usage_error;
  }
  return exit_code;
}

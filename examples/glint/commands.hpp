// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <glint/color/tone_curve.hpp>
#include <glint/math/vec.hpp>

/// The subcommands of the program: what each is asked for, and what does it and returns the exit status.
/// Anything that goes wrong with a file is thrown as glint::IoError, and told by main.
///
/// How the command line is read is known in one unit alone, for CLI11 takes the compiler long.

/// Which scene, and how it is read.
struct SceneArguments {
  std::filesystem::path path{};
  std::vector<std::string> overrides{};
  std::string integrator{};
  bool strict = false;
};

struct RenderArguments {
  SceneArguments scene;
  std::vector<std::filesystem::path> outputs;
  std::optional<int> samples;
  std::optional<std::uint64_t> seed;
  std::optional<glint::Vec2i> resolution;
  int threads = 0;
  int tile_size = 32;
  float exposure = 0;
  std::optional<glint::ToneCurve> tone;
  bool no_png = false;
  bool quiet = false;
};

struct CompareArguments {
  std::filesystem::path image;
  std::filesystem::path reference;
  std::filesystem::path difference_image;
  double max_rmse = std::numeric_limits<double>::infinity();
  double max_relmse = std::numeric_limits<double>::infinity();
  double max_mean_error = std::numeric_limits<double>::infinity();
  double max_share = std::numeric_limits<double>::infinity();
};

int render_file(const RenderArguments& arguments);
int compare_images(const CompareArguments& arguments);
int tell_of_file(const std::filesystem::path& path);

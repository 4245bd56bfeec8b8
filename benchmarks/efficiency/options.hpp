// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <charconv>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <glint/integrator/bdpt.hpp>
#include <glint/integrator/path.hpp>
#include <glint/io/scene_settings.hpp>

namespace glint::bench {

enum class Transport { Path, Bdpt };

inline constexpr std::array<std::pair<std::string_view, Transport>, 2> transports{
    {{"path", Transport::Path}, {"bdpt", Transport::Bdpt}}};
inline constexpr std::array<std::pair<std::string_view, SamplerKind>, 5> samplers{
    {{"zsobol", SamplerKind::ZSobol},
     {"sobol", SamplerKind::Sobol},
     {"halton", SamplerKind::Halton},
     {"stratified", SamplerKind::Stratified},
     {"independent", SamplerKind::Independent}}};

struct EfficiencyOptions {
  bool help = false;
  bool quick = false;
  int threads = 2;
  int samples = 64;
  int reference_samples = 256;
  int repetitions = 3;
  int resolution = 0;   ///< 0: the scene's
  float roulette = -1;  ///< below zero: the integrators' own
  std::string references;
  std::vector<Transport> transports;
  std::vector<SamplerKind> samplers;
  std::vector<std::string> scenes;
};

inline constexpr std::string_view efficiency_help =
    R"(bench_efficiency [SCENE]... [--integrator NAME]... [--sampler NAME]... [--threads N] [--spp N] [--repeat N]
                 [--resolution N] [--roulette X] [--reference-spp N] [--references DIR] [--quick]

Renders scenes by paths of 12 segments, and says what a second buys: 1 / (relMSE · seconds).

relMSE is the mean over pixels and channels of (I - R)^2 / (R^2 + 0.01) against converged images of our own. There are
two of them, independent of each other and of what is measured: the products (I - R1) (I - R2) are taken in place of
squares, so that the noise of the references, whatever is left of it, adds nothing on average.

  SCENE               a file, or cornell_box, cornell_box_glass, cbox, bunny, glass: all of these that are there, if none
                      is given; the last three lie beside the source tree
  --integrator NAME   path or bdpt, any number of times; path unless given, and for glass both
  --sampler NAME      zsobol, sobol, halton, stratified or independent, any number of times; zsobol unless given
  --threads N         2 unless given
  --spp N             samples a pixel, 64 unless given
  --repeat N          renderings with as many seeds, 3 unless given; the medians count
  --resolution N      of the square image in place of the scene's
  --roulette X        the throughput below which paths may be ended, in place of the integrators' own
  --reference-spp N   of each of the two converged images, 256 unless given
  --references DIR    keep converged images there, and use those that are
  --quick             small and noisy: whether it works
  --help

A line to be read by programs for each rendering, by the clock on the wall and by the processor's:
  EFFICIENCY scene integrator sampler relMSE  Msamples/s 1/(relMSE·s)  CPU-Msamples/s 1/(relMSE·CPU-s)
where the processor's seconds are those of all threads over their number: what the clock would say if nobody else used
the processor.
)";

[[nodiscard]] inline int positive_number(const std::string& option, const std::string& text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < 1 || value > 1 << 24)
    throw std::runtime_error(option + ": found '" + text + "', expected a number from 1 to 16777216");
  return value;
}

[[nodiscard]] inline float not_negative_number(const std::string& option, const std::string& text) {
  float value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(value >= 0))
    throw std::runtime_error(option + ": found '" + text + "', expected a number from 0 up");
  return value;
}

template <typename T, std::size_t N>
[[nodiscard]] T named(const std::string& option, const std::string& name,
                      const std::array<std::pair<std::string_view, T>, N>& all) {
  std::string names;
  for (const auto& [known, value] : all) {
    if (known == name) return value;
    names += (names.empty() ? "" : ", ") + std::string(known);
  }
  throw std::runtime_error(option + ": found '" + name + "', expected one of " + names);
}

template <typename T, std::size_t N>
[[nodiscard]] std::string name_of(T value, const std::array<std::pair<std::string_view, T>, N>& all) {
  for (const auto& [name, known] : all) {
    if (known == value) return std::string(name);
  }
  return {};
}

/// Errors: what is not an option, or lacks its value.
[[nodiscard]] inline EfficiencyOptions parse_efficiency_options(const std::vector<std::string>& arguments) {
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
    else if (option == "--integrator")
      options.transports.push_back(named(option, value(), transports));
    else if (option == "--sampler")
      options.samplers.push_back(named(option, value(), samplers));
    else if (option == "--threads")
      options.threads = positive_number(option, value());
    else if (option == "--spp")
      options.samples = positive_number(option, value());
    else if (option == "--repeat")
      options.repetitions = positive_number(option, value());
    else if (option == "--resolution")
      options.resolution = positive_number(option, value());
    else if (option == "--roulette")
      options.roulette = not_negative_number(option, value());
    else if (option == "--reference-spp")
      options.reference_samples = positive_number(option, value());
    else if (option == "--references")
      options.references = value();
    else if (option.starts_with("--"))
      throw std::runtime_error("unknown option '" + option + "'; --help shows those there are");
    else
      options.scenes.push_back(option);
  }
  if (options.samplers.empty()) options.samplers.push_back(SamplerKind::ZSobol);
  if (options.quick) {
    options.resolution = 48;
    options.reference_samples = 128;
    options.repetitions = 1;
  }
  return options;
}

}  // namespace glint::bench

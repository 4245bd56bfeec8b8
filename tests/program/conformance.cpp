// SPDX-License-Identifier: MIT
#include <array>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <glint/color/compare.hpp>
#include <glint/io/image.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

#include "program.hpp"

namespace {

using glint::Image;
using glint::read_exr;
using glint::Rgb;
using glint::testing::glint_program;
using glint::testing::Outcome;
using glint::testing::shared_path;
using glint::testing::TemporaryDirectory;

/// Millions of paths are too many for a program that is watched at every step, or not optimized.
bool too_slow() {
#ifdef NDEBUG
  constexpr bool slow = GLINT_SANITIZED != 0;
#else
  constexpr bool slow = true;
#endif
  if (slow) WARN("skipped: this build is too slow to render whole images");
  return slow;
}

Image rendered(const std::filesystem::path& scene, std::vector<std::string> arguments) {
  const TemporaryDirectory directory;
  arguments.insert(arguments.begin(), {"render", scene.string(), "-o", "image.exr", "--no-png", "--quiet"});
  const Outcome outcome = glint_program(directory.path(), arguments);
  CAPTURE(outcome.err);
  REQUIRE(outcome.status == 0);
  return read_exr(directory / "image.exr");
}

/// What a part of an image should be on average: the mean of several renderers.
struct Patch {
  std::string name;
  glint::Vec2i begin;
  glint::Vec2i end;
  std::array<double, 3> mean;
  double tolerance;  ///< relative
};

/// Two renderings with different seeds: their mean, and from their difference the standard error of a part of it.
struct Estimate {
  Image first;
  Image second;

  Estimate(const std::filesystem::path& scene, const std::string& samples)
      : first(rendered(scene, {"--spp", samples, "--seed", "1"})),
        second(rendered(scene, {"--spp", samples, "--seed", "2"})) {}

  void check(const Patch& patch) const {
    constexpr std::array channels{&Rgb::r, &Rgb::g, &Rgb::b};
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      double squares = 0;
      double pixels = 0;
      for (int y = patch.begin.y; y < patch.end.y; ++y) {
        for (int x = patch.begin.x; x < patch.end.x; ++x, ++pixels) {
          const double a = static_cast<double>(first(x, y).*channels[c]);
          const double b = static_cast<double>(second(x, y).*channels[c]);
          sum += (a + b) / 2;
          squares += (a - b) * (a - b);
        }
      }
      // Of a and b each has variance v: their difference 2v, their mean v / 2, hence the mean over pixels this error.
      const double standard_error = std::sqrt(squares / 4) / pixels;
      CAPTURE(patch.name, c, standard_error);
      CHECK(std::abs(sum / pixels - patch.mean[c]) <= patch.tolerance * patch.mean[c] + 3 * standard_error + 1e-4);
    }
  }
};

}  // namespace

TEST_CASE("conformance: the Cornell box under a point light agrees with its reference images", "[conformance]") {
  const auto scene = shared_path("scenes/course/cbox_no_light.json");
  const auto physical = shared_path("scenes/course/reference/cbox_no_light_physical.exr");
  const auto square = shared_path("scenes/course/reference/cbox_no_light.exr");
  if (!scene || !physical || !square || too_slow()) return;
  const auto check = [&](const std::filesystem::path& reference, const std::vector<std::string>& arguments) {
    const auto difference = glint::compare(rendered(*scene, arguments), read_exr(reference));
    REQUIRE(difference);
    CHECK(difference->rmse < 0.006);
    CHECK(difference->relmse < 6e-4);
    CHECK(std::abs(difference->mean_ratio - 1) < 5e-4);
    CHECK(difference->share_above < 0.012);
  };
  check(*physical, {});
  check(*square, {"--override", R"({"integrator": {"falloff": "square"}})"});
}

TEST_CASE("conformance: the Cornell box under its lamp has the means that several renderers agree on",
          "[conformance]") {
  const auto scene = shared_path("scenes/oracles/cbox.json");
  if (!scene || too_slow()) return;
  const Estimate estimate(*scene, "16");
  for (const Patch& patch : {Patch{"whole", {0, 0}, {512, 512}, {.2792, .1733, .0628}, .001},
                             Patch{"back wall", {230, 150}, {282, 200}, {.4462, .2854, .1065}, .005},
                             Patch{"left wall", {20, 220}, {60, 300}, {.2947, .0201, .0060}, .005},
                             Patch{"right wall", {452, 220}, {492, 300}, {.0543, .1219, .0092}, .005},
                             Patch{"floor front", {230, 470}, {282, 500}, {.1393, .0971, .0347}, .005},
                             Patch{"light", {240, 37}, {272, 46}, {17, 12, 5}, .005}}) {
    estimate.check(patch);
  }
}

TEST_CASE("conformance: the bunny has the means that several renderers agree on", "[conformance]") {
  const auto scene = shared_path("scenes/oracles/bunny.json");
  if (!scene || too_slow()) return;
  const Estimate estimate(*scene, "8");
  for (const Patch& patch : {Patch{"whole", {0, 0}, {512, 512}, {.1662, .1546, .1433}, .001},
                             Patch{"floor right", {400, 380}, {480, 440}, {.4238, .4218, .4199}, .005},
                             Patch{"floor front", {230, 470}, {282, 500}, {.4215, .4199, .4185}, .005},
                             Patch{"floor far left", {20, 250}, {60, 290}, {.0316, .0316, .0316}, .005},
                             Patch{"flank", {300, 290}, {380, 350}, {.3475, .2896, .2323}, .005},
                             Patch{"shadow", {40, 348}, {80, 364}, {.0591, .0589, .0586}, .005}}) {
    estimate.check(patch);
  }
}

TEST_CASE("conformance: a scene for bidirectional paths renders as it asks for", "[conformance]") {
  const auto scene = shared_path("scenes/course/cbox.json");
  if (!scene) return;
  const TemporaryDirectory directory;
  const Outcome outcome = glint_program(
      directory.path(), {"render", scene->string(), "--spp", "2", "--resolution", "32x32", "--quiet", "--strict"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err.empty());
  CHECK(read_exr(directory / "cbox.exr").size() == glint::Vec2i(32, 32));
}

// SPDX-License-Identifier: MIT
#include <chrono>
#include <cmath>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include <glint/io/image.hpp>

#include <support/catch.hpp>

#include "program.hpp"

namespace {

using glint::Image;
using glint::read_exr;
using glint::read_image;
using glint::Rgb;
using glint::testing::content_of;
using glint::testing::entries_below;
using glint::testing::glint_program;
using glint::testing::Outcome;
using glint::testing::Program;
using glint::testing::TemporaryDirectory;
using glint::testing::write_scene;
using Names = std::set<std::string>;

/// A directory with the scene in a folder, and runs beside it.
struct Workshop {
  TemporaryDirectory directory;

  Workshop() { write_scene(directory); }

  [[nodiscard]] Outcome render(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {"render", "scene.json"});
    return glint_program(directory.path(), arguments);
  }
  /// The bytes of a rendering.
  [[nodiscard]] std::string rendered(std::vector<std::string> arguments) const {
    arguments.insert(arguments.end(), {"-o", "rendered.exr", "--no-png", "--quiet"});
    const Outcome outcome = render(arguments);
    CAPTURE(outcome.err);
    REQUIRE(outcome.status == 0);
    return content_of(directory / "rendered.exr");
  }
};

double mean(const Image& image) {
  double sum = 0;
  for (const Rgb& pixel : image.pixels()) sum += static_cast<double>(pixel.r + pixel.g + pixel.b);
  return sum / (3.0 * static_cast<double>(image.pixels().size()));
}

}  // namespace

TEST_CASE("program: render writes SCENE.exr and SCENE.png into the working directory", "[program]") {
  const Workshop workshop;
  const TemporaryDirectory elsewhere;
  const Outcome outcome = glint_program(elsewhere.path(), {"render", (workshop.directory / "scene.json").string()});
  CAPTURE(outcome.err);
  CHECK(outcome.status == 0);
  CHECK(entries_below(elsewhere.path()) == Names{"scene.exr", "scene.png"});
  CHECK(entries_below(workshop.directory.path()) == Names{"floor.obj", "scene.json"});
  const Image exr = read_exr(elsewhere / "scene.exr");
  CHECK(exr.size() == glint::Vec2i(24, 16));
  CHECK(mean(exr) > 0.01);
  // 8 bits of sRGB: half a step of 1 / 255 where the curve is steepest in linear light, 2.4 · 255⁻¹ at white.
  const Image png = read_image(elsewhere / "scene.png");
  for (std::size_t i = 0; i < exr.pixels().size(); ++i) {
    CHECK(png.pixels()[i].g == Approx(std::min(1.0F, exr.pixels()[i].g)).margin(0.005));
  }
}

TEST_CASE("program: render says what it did", "[program]") {
  const Workshop workshop;
  const Outcome outcome = workshop.render({});
  CHECK(outcome.out.find("24x16, 4 samples a pixel") != std::string::npos);
  CHECK(outcome.out.find("M samples/s") != std::string::npos);
  CHECK(outcome.out.find("M rays/s") != std::string::npos);
  CHECK(outcome.out.find("wrote " + (workshop.directory / "scene.exr").string() + "\n") != std::string::npos);
  CHECK(outcome.err.find("100 %") != std::string::npos);
  CHECK(outcome.err.find('\r') == std::string::npos);  // no bar where there is no terminal
}

TEST_CASE("program: render --quiet says nothing but warnings", "[program]") {
  const Workshop workshop;
  const Outcome quiet = workshop.render({"--quiet"});
  CHECK(quiet.status == 0);
  CHECK(quiet.out.empty());
  CHECK(quiet.err.empty());
  const Outcome warned = workshop.render({"--quiet", "--override", R"({"film": {"resolutoin": [4, 4]}})"});
  CHECK(warned.status == 0);
  CHECK(warned.out.empty());
  CHECK(warned.err == "glint: warning: scene.json:/film/resolutoin: unknown key; did you mean \"resolution\"?\n");
}

TEST_CASE("program: render -o may be given several times, and a PNG accompanies an EXR unless there is one",
          "[program]") {
  const Workshop workshop;
  const auto written = [&](const std::vector<std::string>& arguments) {
    const Outcome outcome = workshop.render(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.status == 0);
    Names names = entries_below(workshop.directory.path());
    names.erase("scene.json");
    names.erase("floor.obj");
    for (const std::string& name : names) std::filesystem::remove_all(workshop.directory / name);
    return names;
  };
  CHECK(written({"-o", "a.exr"}) == Names{"a.exr", "a.png"});
  CHECK(written({"-o", "a.exr", "-o", "b.png"}) == Names{"a.exr", "b.png"});
  CHECK(written({"-o", "a.exr", "-o", "b.exr", "--output", "c.hdr"}) == Names{"a.exr", "b.exr", "c.hdr", "a.png"});
  CHECK(written({"-o", "a.exr", "--no-png"}) == Names{"a.exr"});
  CHECK(written({"-o", "a.PNG"}) == Names{"a.PNG"});
}

TEST_CASE("program: render's outputs replace former ones", "[program]") {
  const Workshop workshop;
  workshop.directory.write("a.exr", "old");
  CHECK(workshop.render({"-o", "a.exr"}).status == 0);
  CHECK(read_exr(workshop.directory / "a.exr").width() == 24);
}

TEST_CASE("program: render's options replace what the scene says", "[program]") {
  const Workshop workshop;
  CHECK(workshop.render({"--resolution", "10x5", "--spp", "2"}).out.find("10x5, 2 samples a pixel") !=
        std::string::npos);
  CHECK(read_exr(workshop.directory / "scene.exr").size() == glint::Vec2i(10, 5));
  const std::string as_is = workshop.rendered({});
  CHECK(workshop.rendered({"--seed", "0"}) == as_is);
  CHECK(workshop.rendered({"--seed", "1"}) != as_is);
  CHECK(workshop.rendered({"--seed", "18446744073709551615"}) != as_is);
  CHECK(workshop.rendered({"--spp", "5"}) != as_is);
  CHECK(workshop.rendered({"--integrator", "path"}) != as_is);
  CHECK(workshop.rendered({"--override", R"({"camera": {"fov": 40}})"}) == as_is);
  CHECK(workshop.rendered({"--override", R"({"camera": {"fov": 41}})"}) != as_is);
}

TEST_CASE("program: render makes the same bytes with any number of threads and any tile size", "[program]") {
  const Workshop workshop;
  // A wide filter, so that samples reach over the borders of tiles; paths, so that their lengths differ.
  const auto rendered = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--resolution", "70x50", "--integrator", "path", "--override",
                                       R"({"film": {"filter": {"type": "gaussian", "radius": 2}}})"});
    return workshop.rendered(arguments);
  };
  const std::string one = rendered({"--threads", "1"});
  CHECK(rendered({"--threads", "2"}) == one);
  CHECK(rendered({"--threads", "5"}) == one);
  CHECK(rendered({}) == one);
  for (const char* const size : {"1", "16", "33", "64", "1000"}) {
    CAPTURE(size);
    CHECK(rendered({"--threads", "2", "--tile-size", size}) == one);
  }
}

TEST_CASE("program: render --exposure doubles the PNG's light a stop, and leaves the EXR alone", "[program]") {
  const Workshop workshop;
  CHECK(workshop.render({"-o", "plain.exr"}).status == 0);
  CHECK(workshop.render({"-o", "darker.exr", "--exposure", "-1"}).status == 0);
  CHECK(content_of(workshop.directory / "plain.exr") == content_of(workshop.directory / "darker.exr"));
  const Image exr = read_exr(workshop.directory / "plain.exr");
  const Image png = read_image(workshop.directory / "darker.png");
  for (std::size_t i = 0; i < exr.pixels().size(); ++i) {
    CHECK(png.pixels()[i].r == Approx(std::min(1.0F, exr.pixels()[i].r / 2)).margin(0.005));
  }
}

TEST_CASE("program: render says in its report where light is clamped", "[program]") {
  const Workshop workshop;
  const auto report = [&](const char* integrator) {
    return workshop.render({"--integrator", "path", "--override", integrator}).out;
  };
  CHECK(report(R"({"integrator": {"clamp_indirect": 2}})").find("light is clamped (direct inf, indirect 2)") !=
        std::string::npos);
  CHECK(report("{}").find("clamp") == std::string::npos);
}

TEST_CASE("program: render --tone bends the PNG's light, and leaves the EXR alone", "[program]") {
  const Workshop workshop;
  CHECK(workshop.render({"-o", "plain.exr"}).status == 0);
  CHECK(workshop.render({"-o", "filmic.exr", "--tone", "filmic"}).status == 0);
  CHECK(workshop.render({"-o", "scene.exr", "--override", R"({"film": {"tone": "filmic"}})"}).status == 0);
  CHECK(content_of(workshop.directory / "plain.exr") == content_of(workshop.directory / "filmic.exr"));
  CHECK(content_of(workshop.directory / "plain.png") != content_of(workshop.directory / "filmic.png"));
  CHECK(content_of(workshop.directory / "scene.png") == content_of(workshop.directory / "filmic.png"));
  const Outcome outcome = workshop.render({"--tone", "aces"});
  CHECK(outcome.status == 2);
  CHECK(outcome.err.find("found \"aces\", expected one of clip, filmic, hable, agx") != std::string::npos);
}

TEST_CASE("program: render --strict makes unknown keys errors", "[program]") {
  const Workshop workshop;
  CHECK(workshop.render({"--strict"}).status == 0);
  const Outcome outcome = workshop.render({"--strict", "--override", R"({"films": {}})"});
  CHECK(outcome.status == 1);
  CHECK(outcome.err == "glint: scene.json:/films: unknown key; did you mean \"film\"?\n");
}

TEST_CASE("program: render tells of an integrator it stands in for", "[program]") {
  const Workshop workshop;
  const Outcome outcome = workshop.render({"--override", R"({"integrator": {"type": "photon"}})", "--quiet"});
  CHECK(outcome.status == 0);
  CHECK(outcome.err ==
        "glint: warning: scene.json:/integrator/type: rendered with \"path\", as this integrator is "
        "not available\n");
}

TEST_CASE("program: a scene without anything in it is black", "[program]") {
  const Workshop workshop;
  workshop.directory.write("empty.json", R"({"integrator": {}, "film": {"resolution": [4, 4]}, "camera": {}})");
  CHECK(glint_program(workshop.directory.path(), {"render", "empty.json"}).status == 0);
  const Image image = read_exr(workshop.directory / "empty.exr");
  for (const Rgb& pixel : image.pixels()) CHECK(pixel == Rgb{0});
}

TEST_CASE("program: every kind of object, light, material and texture renders, without a sample lost", "[program]") {
  const Workshop workshop;
  glint::Image sky({8, 4}, {0.25F, 0.5F, 1});
  write_exr(sky, workshop.directory / "sky.exr");
  workshop.directory.write("all.json", R"({
    "integrator": {"type": "path", "spp": 4, "max_depth": 5},
    "film": {"resolution": [24, 16], "filter": {"type": "mitchell", "radius": 2}},
    "camera": {"type": "thin_lens", "position": [0, 2, 8], "look_at": [0, 1, 0], "lens_radius": 0.1},
    "sampler": {"type": "stratified"}, "accelerator": {"builder": "sweep_sah"},
    "textures": {"grey": {"type": "constant", "color": [0.6, 0.5, 0.4]}, "board": {"type": "checkerboard"},
                 "sky": {"type": "image", "path": "sky.exr"}},
    "materials": {"matte": {"texture_name": "board", "twosided": true}, "glass": {"type": "glass"},
                  "water": {"type": "refraction", "eta": 1.33}, "mirror": {"type": "mirror"},
                  "metal": {"type": "roughconductor", "texture_name": "grey"}},
    "objects": [{"type": "mesh", "path": "floor.obj", "material_name": "matte", "translate": [0, -1, 0]},
                {"type": "sphere", "center": [-2, 1, 0], "material_name": "glass"},
                {"type": "sphere", "center": [2, 1, 0], "material_name": "metal"},
                {"type": "disk", "center": [0, 1, -2], "material_name": "mirror"},
                {"type": "rectangle", "center": [0, 1, 1], "material_name": "water"},
                {"type": "sphere", "center": [0, 5, 0], "radius": 0.5, "light": {}}],
    "lights": [{"type": "point", "position": [1, 3, 1], "flux": [9, 9, 9]},
               {"type": "spot", "position": [0, 4, 4], "direction": [0, -1, -1], "intensity": [9, 9, 9]},
               {"type": "directional", "direction": [1, -1, 0], "irradiance": [1, 1, 1]},
               {"type": "rectangle", "center": [0, 6, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1],
                "radiance": [5, 5, 5]}],
    "environment_map": {"texture_name": "sky", "scale": 0.5}})");
  for (const char* const integrator : {"path", "intersection_test"}) {
    const Outcome outcome = glint_program(workshop.directory.path(),
                                          {"render", "all.json", "--strict", "--quiet", "--integrator", integrator});
    CHECK(outcome.status == 0);
    CHECK(outcome.err.empty());
    const Image image = read_exr(workshop.directory / "all.exr");
    CHECK(mean(image) > 0.05);
    CHECK(mean(image) < 10);
  }
}

TEST_CASE("program: Ctrl-C ends a rendering soon, with status 130 and no file", "[program]") {
  const Workshop workshop;
  const auto before = entries_below(workshop.directory.path());
  // At 2²⁰ samples a tile would take minutes.
  const Program program(workshop.directory.path(),
                        {"render", "scene.json", "--spp", "1048576", "--resolution", "64x64"});
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  program.interrupt();
  const Outcome outcome = program.wait();
  CHECK(outcome.status == 130);
  CHECK(outcome.out.empty());
  CHECK(entries_below(workshop.directory.path()) == before);
}

// SPDX-License-Identifier: MIT
#include <glint/io/scene_json.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_scene_json {

namespace {

using glint::IoError;
using glint::SceneFile;
using glint::SceneReadOptions;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

const std::string smallest = R"({"integrator": {}, "film": {}, "camera": {}})";

SceneFile scene_from(const std::string& text, const SceneReadOptions& options = {}) {
  const TemporaryDirectory directory;
  return glint::read_scene(directory.write("scene.json", text), options);
}

std::string scene_error(const std::string& text, const SceneReadOptions& options = {}) {
  const TemporaryDirectory directory;
  const auto path = directory.write("scene.json", text);
  return message_of<IoError>([&] { (void)glint::read_scene(path, options); }, directory.path().string() + "/");
}

std::vector<std::string> warnings_of(const std::string& text) {
  const TemporaryDirectory directory;
  auto warnings = glint::read_scene(directory.write("scene.json", text)).warnings;
  for (std::string& warning : warnings) warning.erase(0, directory.path().string().size() + 1);
  return warnings;
}

}  // namespace

TEST_CASE("scene: an integrator, a film and a camera are enough", "[io][scene]") {
  const SceneFile scene = scene_from(smallest);
  CHECK(scene.film.resolution == glint::Vec2i(600, 600));
  CHECK(scene.shapes().size() == 0);
  CHECK(scene.lights.empty());
  CHECK(scene.warnings.empty());
  REQUIRE(scene.inputs.size() == 1);
  CHECK(scene.inputs[0].filename() == "scene.json");
}

TEST_CASE("scene: each of the three is required", "[io][scene]") {
  CHECK(scene_error("{}") == "scene.json: the key \"integrator\" is missing");
  CHECK(scene_error(R"({"integrator": {}})") == "scene.json: the key \"film\" is missing");
  CHECK(scene_error(R"({"integrator": {}, "film": {}})") == "scene.json: the key \"camera\" is missing");
  CHECK(scene_error("[]") == "scene.json: found an array of 0, expected an object");
  CHECK(scene_error(R"({"integrator": {}, "film": [], "camera": {}})") ==
        "scene.json:/film: found an array of 0, expected an object");
}

TEST_CASE("scene: parts find each other by name, whatever their order in the file", "[io][scene]") {
  const SceneFile scene = scene_from(R"({
    "objects": [{"type": "sphere", "material_name": "m"}, {"type": "sphere", "light": {}}],
    "environment_map": {"texture_name": "t", "scale": 2},
    "materials": {"m": {"texture_name": "t"}},
    "textures": {"t": {"type": "constant", "color": [0.5, 0.5, 0.5]}},
    "lights": [{"type": "point", "position": [0, 1, 0], "flux": [1, 1, 1]}],
    "sampler": {"type": "stratified", "seed": 3}, "accelerator": {"builder": "median"},
    "integrator": {"type": "intersection_test"}, "film": {}, "camera": {}})");
  CHECK(scene.warnings.empty());
  CHECK(scene.spheres.size() == 2);
  CHECK(scene.lights.size() == 3);  // the second sphere, the point, the environment: and no default point light
  CHECK(scene.sampler.seed == 3);
  CHECK(scene.accelerator.builder == glint::BuilderKind::Median);
}

TEST_CASE("scene: the point lights of the integrator light the scene, whichever it is", "[io][scene]") {
  for (const char* const type : {"intersection_test", "path"}) {
    const auto scene = scene_from(R"({"integrator": {"type": ")" + std::string(type) +
                                  R"(", "point_light_position": [1, 2, 3]}, "film": {}, "camera": {}})");
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].get_if<glint::PointLight>()->position == glint::Vec3<float>(1, 2, 3));
  }
}

TEST_CASE("scene: unknown keys are warnings anywhere, and errors where strict", "[io][scene]") {
  const std::string text = R"({"integrator": {"sp": 3}, "film": {}, "camera": {"fow": 3}, "object": []})";
  CHECK(warnings_of(text) == std::vector<std::string>{"scene.json:/integrator/sp: unknown key; did you mean \"spp\"?",
                                                      "scene.json:/camera/fow: unknown key; did you mean \"fov\"?",
                                                      "scene.json:/object: unknown key; did you mean \"objects\"?"});
  CHECK(scene_error(text, {.strict = true}) == "scene.json:/integrator/sp: unknown key; did you mean \"spp\"?");
}

TEST_CASE("scene: overrides are merged one after the other", "[io][scene]") {
  const SceneFile scene = scene_from(
      R"({"integrator": {"type": "path", "spp": 4, "max_depth": 3}, "film": {"resolution": [8, 8]}, "camera": {}})",
      {.overrides = {R"({"integrator": {"spp": 5}})",
                     R"({"integrator": {"spp": 6}, "film": {"resolution": [2, 3]}})"}});
  CHECK(scene.integrator.samples == 6);
  CHECK(scene.integrator.integrator.get_if<glint::Path>()->max_depth == 3);
  CHECK(scene.film.resolution == glint::Vec2i(2, 3));
}

TEST_CASE("scene: paths in an override are relative to the scene's folder too", "[io][scene]") {
  const TemporaryDirectory directory;
  directory.write("t.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const auto path = directory.write("scene.json", smallest);
  const auto scene =
      glint::read_scene(path, {.overrides = {R"({"objects": [{"type": "mesh", "path": "t.obj", "light": {}}]})"}});
  CHECK(scene.triangle_count() == 1);
  CHECK(scene.inputs == std::vector{path, directory / "t.obj"});
}

TEST_CASE("scene: what is wrong with an override names it", "[io][scene]") {
  CHECK(scene_error(smallest, {.overrides = {"{"}}).starts_with("--override:1: is not JSON: syntax error"));
  CHECK(scene_error(smallest, {.overrides = {"[1]"}}) == "--override: found an array of 1, expected an object");
  CHECK(scene_error(smallest, {.overrides = {R"({"film": {"resolution": [1e999, 1]}})"}}) ==
        "--override:1: is not JSON: number overflow parsing '1e999'");
}

TEST_CASE("scene: another integrator can be asked for", "[io][scene]") {
  const auto scene = scene_from(R"({"integrator": {"type": "bdpt", "spp": 3}, "film": {}, "camera": {}})",
                                {.integrator = "intersection_test"});
  CHECK(scene.integrator.integrator.get_if<glint::IntersectionTest>() != nullptr);
  CHECK(scene.integrator.samples == 3);
  CHECK(scene.warnings.empty());
  CHECK(
      scene_error(smallest, {.integrator = "psth"}) ==
      "--integrator: found \"psth\", expected one of \"intersection_test\", \"path\", \"random_walk\", "
      "\"direct\", \"light_tracer\", \"bdpt\", \"ambient_occlusion\", \"normals\", \"photon\"; did you mean \"path\"?");
}

TEST_CASE("scene: files that are no scenes are errors with their name", "[io][scene]") {
  CHECK(scene_error("{\"integrator\": {},\n\n oops").starts_with("scene.json:3: is not JSON: syntax error"));
  CHECK(scene_error("").starts_with("scene.json:1: is not JSON: syntax error"));
  CHECK(message_of<IoError>([] { (void)glint::read_scene("no/such.json"); }) ==
        "no/such.json: cannot be read: No such file or directory");
  CHECK(message_of<IoError>([] { (void)glint::read_scene("/"); }) == "/: is a directory, expected a file");
}

TEST_CASE("scene: a byte order mark and keys that come twice are endured", "[io][scene]") {
  const std::string text = "\xEF\xBB\xBF" + smallest;
  CHECK(scene_from(text).warnings.empty());
  CHECK(warnings_of(R"({"integrator": {"spp": 1, "spp": 2}, "film": {}, "camera": {}})") ==
        std::vector<std::string>{"scene.json:/integrator/spp: the key comes twice, and only its last value counts"});
}

TEST_CASE("scene: places in lists are told by number", "[io][scene]") {
  CHECK(scene_error(
            R"({"integrator": {}, "film": {}, "camera": {}, "objects": [{"type": "sphere", "light": {}}, {}]})") ==
        "scene.json:/objects/1: the key \"type\" is missing");
  CHECK(scene_error(R"({"integrator": {}, "film": {}, "camera": {}, "objects": {}})") ==
        "scene.json:/objects: found an object, expected an array");
  CHECK(scene_error(R"({"integrator": {}, "film": {}, "camera": {}, "materials": {"a/b": {}}})") ==
        "scene.json:/materials/a~1b: the key \"texture_name\" is missing");
}

}  // namespace test_io_scene_json

// SPDX-License-Identifier: MIT
#include <glint/io/scene_lights.hpp>  // first, so the header proves it stands alone

#include <memory>
#include <string>

#include <glm/geometric.hpp>

#include <support/catch.hpp>
#include <support/json_text.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_scene_lights {

namespace {

using glint::JsonObject;
using glint::Rgb;
using glint::Vec3;
using glint::detail::SceneDraft;
using glint::testing::json_error;
using glint::testing::JsonText;
using Environment = glint::EnvironmentLight<glint::SceneTexture>;

SceneDraft draft_with_textures() {
  SceneDraft draft;
  draft.textures.emplace("white", glint::ConstantTexture{1});
  glint::Image image({4, 2});  // columns look along −z and +x, +x and +z, +z and −x, −x and −z: red leads +x to +z
  image(1, 0) = image(1, 1) = {1, 0, 0};
  draft.textures.emplace("red", glint::ImageTexture{.image = std::make_shared<const glint::Image>(image),
                                                    .interpolation = glint::Interpolation::Nearest});
  for (int x = 0; x < 4; ++x) image(x, 0) = image(x, 1) = x == 1 ? Rgb{1} : Rgb{0.1F};
  draft.textures.emplace("dusk", glint::ImageTexture{.image = std::make_shared<const glint::Image>(image)});
  return draft;
}

template <typename T>
T light_of(const char* text) {
  JsonText json(text);
  SceneDraft draft;
  glint::detail::read_light(json.object(), draft);
  CHECK(json.source.warnings.empty());
  REQUIRE(draft.scene.lights.size() == 1);
  REQUIRE(draft.scene.lights[0].get_if<T>() != nullptr);
  return *draft.scene.lights[0].get_if<T>();
}

Environment environment_of(const char* text) {
  JsonText json(text);
  SceneDraft draft = draft_with_textures();
  glint::detail::read_environment(json.object(), draft);
  CHECK(json.source.warnings.empty());
  REQUIRE(draft.scene.lights.size() == 1);
  return *draft.scene.lights[0].get_if<Environment>();
}

std::string light_error(const char* text) {
  return json_error(text, [](JsonObject object) {
    SceneDraft draft;
    glint::detail::read_light(std::move(object), draft);
    return 0;
  });
}

std::string environment_error(const char* text) {
  return json_error(text, [](JsonObject object) {
    SceneDraft draft = draft_with_textures();
    glint::detail::read_environment(std::move(object), draft);
    return 0;
  });
}

}  // namespace

TEST_CASE("scene lights: a point has a flux or an intensity", "[io][scene]") {
  CHECK(light_of<glint::PointLight>(R"({"type": "point", "position": [1, 2, 3], "flux": [4, 5, 6]})") ==
        glint::PointLight::from_flux({1, 2, 3}, {4, 5, 6}));
  CHECK(light_of<glint::PointLight>(R"({"type": "point", "position": [1, 2, 3], "intensity": [4, 5, 6]})") ==
        glint::PointLight{{1, 2, 3}, {4, 5, 6}});
}

TEST_CASE("scene lights: the angles of a spot are from its axis, in degrees", "[io][scene]") {
  const auto spot = light_of<glint::SpotLight>(
      R"({"type": "spot", "position": [0, 5, 0], "direction": [0, -2, 0], "intensity": [1, 2, 3], "cone_angle": 60,
          "falloff_start": 45})");
  CHECK(spot.position == Vec3<float>(0, 5, 0));
  CHECK(spot.direction == Vec3<float>(0, -2, 0));
  CHECK(spot.cone_angle_radians == Approx(3.14159265 / 3));
  CHECK(spot.falloff_start_radians == Approx(3.14159265 / 4));
  const auto usual = light_of<glint::SpotLight>(R"({"type": "spot", "position": [0, 5, 0], "direction": [0, -1, 0],
                                     "intensity": [1, 1, 1]})");
  CHECK(usual.cone_angle_radians == Approx(3.14159265 / 6));
  CHECK(usual.falloff_start_radians == Approx(0.8 * 3.14159265 / 6));
}

TEST_CASE("scene lights: a directional light shines where its direction points to", "[io][scene]") {
  const auto sun =
      light_of<glint::DirectionalLight>(R"({"type": "directional", "direction": [0, -3, 0], "irradiance": [1, 2, 3]})");
  const auto sample = sun.sample(Vec3<float>(0), {0, 0});
  REQUIRE(sample);
  CHECK(sample->wi == Vec3<float>(0, 1, 0));
  CHECK(sample->radiance == Rgb{1, 2, 3});
}

TEST_CASE("scene lights: a rectangle is seen as well", "[io][scene]") {
  for (const char* const type : {"rectangle", "area"}) {
    JsonText json(std::string(R"({"center": [0, 2, 0], "edge_u": [1, 0, 0], "edge_v": [0, 0, 1],
                                  "radiance": [4, 5, 6], "type": ")") +
                  type + "\"}");
    SceneDraft draft;
    glint::detail::read_light(json.object(), draft);
    REQUIRE(draft.scene.quads.size() == 1);
    CHECK(draft.scene.attributes[3].lights == std::vector<std::uint32_t>{0});
    const auto* light = draft.scene.lights[0].get_if<glint::AreaLight<glint::Quad<float>>>();
    REQUIRE(light != nullptr);
    CHECK(light->radiance == Rgb{4, 5, 6});
    CHECK(glm::cross(light->shape.edge_u, light->shape.edge_v) == Vec3<float>(0, -1, 0));  // x × z: down
  }
}

TEST_CASE("scene lights: a wrong light is an error that tells what was found and expected", "[io][scene]") {
  CHECK(light_error("{}") == "/x: the key \"type\" is missing");
  CHECK(light_error(R"({"type": "sun"})") ==
        "/x/type: found \"sun\", expected one of \"point\", \"spot\", "
        "\"directional\", \"rectangle\", \"area\"");
  CHECK(light_error(R"({"type": "point", "position": [0, 0, 0], "flux": [1, 1, 1], "intensity": [1, 1, 1]})") ==
        "/x: a point light has either \"flux\" or \"intensity\"");
  CHECK(light_error(R"({"type": "spot", "position": [0, 0, 0], "direction": [0, 0, 0], "intensity": [1, 1, 1]})") ==
        "/x/direction: found an array of 3, expected a vector that is not zero");
  CHECK(light_error(R"({"type": "spot", "position": [0, 0, 0], "direction": [0, 1, 0], "intensity": [1, 1, 1],
                        "cone_angle": 20, "falloff_start": 30})") ==
        "/x: expected 0 <= \"falloff_start\" <= \"cone_angle\" <= 180 degrees");
  CHECK(light_error(R"({"type": "directional", "direction": [0, 1, 0]})") == "/x: the key \"irradiance\" is missing");
  CHECK(light_error(R"({"type": "rectangle", "edge_u": [1, 0, 0]})") == "/x: the key \"radiance\" is missing");
}

TEST_CASE("scene lights: an environment is its texture, scaled", "[io][scene]") {
  const auto environment = environment_of(R"({"texture_name": "white", "scale": 2.5})");
  CHECK(environment.background({0, 1, 0}) == Rgb{2.5F});
  CHECK(environment_of(R"({"texture_name": "white"})").background({1, 0, 0}) == Rgb{1});
}

TEST_CASE("scene lights: a compensated environment leaves what is darker than its mean to chance", "[io][scene]") {
  const Vec3<float> dim = glm::normalize(Vec3<float>{-1, 0, -1});
  CHECK(environment_of(R"({"texture_name": "dusk"})").pdf(dim) > 0);
  CHECK(environment_of(R"({"texture_name": "dusk", "mis_compensation": true})").pdf(dim) == 0);
  SceneDraft draft = draft_with_textures();
  draft.scene.integrator.integrator = glint::Bdpt{};
  JsonText json(R"({"texture_name": "red", "mis_compensation": true})");
  CHECK(glint::testing::message_of<glint::IoError>([&] { glint::detail::read_environment(json.object("/x"), draft); },
                                                   "scene.json:") ==
        "/x: \"mis_compensation\" is right only for the integrators \"path\" and \"direct\" with the profile \"MIS\"");
}

TEST_CASE("scene lights: u = atan2(x, -z) / 2 pi, so the second quarter of an environment lies between +x and +z",
          "[io][scene]") {
  const auto environment = environment_of(R"({"texture_name": "red"})");
  CHECK(environment.background({1, 0, 1}) == Rgb{1, 0, 0});
  CHECK(environment.background({1, 0, -1}) == Rgb{0});
  CHECK(environment.background({-1, 0, 1}) == Rgb{0});
}

TEST_CASE("scene lights: the transform of an environment carries its directions into the world", "[io][scene]") {
  // A turn about y that takes x to z and z to −x: what was seen at (1, 0, 1) is seen at (−1, 0, 1).
  const auto environment =
      environment_of(R"({"texture_name": "red", "transform": [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]})");
  CHECK(environment.background({-1, 0, 1}) == Rgb{1, 0, 0});
  CHECK(environment.background({1, 0, 1}) == Rgb{0});
}

TEST_CASE("scene lights: a wrong environment is an error that tells what was found and expected", "[io][scene]") {
  CHECK(environment_error("{}") == "/x: the key \"texture_name\" is missing");
  CHECK(environment_error(R"({"texture_name": "sky"})") == "/x/texture_name: there is no texture named \"sky\"");
  CHECK(environment_error(R"({"texture_name": "white", "scale": -1})") ==
        "/x/scale: found -1, expected a number from 0 up");
  CHECK(environment_error(R"({"texture_name": "white", "transform": [0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1]})") ==
        "/x/transform: found [0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,1], expected a matrix with an inverse");
}

}  // namespace test_io_scene_lights

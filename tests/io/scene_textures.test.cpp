// SPDX-License-Identifier: MIT
#include <glint/io/scene_textures.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace {

using glint::JsonObject;
using glint::Rgb;
using glint::SceneTexture;
using glint::detail::SceneDraft;
using glint::testing::json_error;
using glint::testing::JsonText;
using glint::testing::TemporaryDirectory;

SceneTexture texture_of(const std::string& text, const std::filesystem::path& folder = {}) {
  JsonText json(text);
  json.source.path = folder / "scene.json";
  SceneDraft draft;
  auto texture = glint::detail::read_texture(json.object(), draft);
  CHECK(json.source.warnings.empty());
  return texture;
}

std::string texture_error(const char* text) {
  return json_error(text, [](JsonObject object) {
    SceneDraft draft;
    return glint::detail::read_texture(std::move(object), draft);
  });
}

}  // namespace

TEST_CASE("scene textures: a constant is its color", "[io][scene]") {
  CHECK(texture_of(R"({"type": "constant", "color": [0.1, 0.2, 0.3]})").evaluate(glint::Vec2<float>{0.7F, 0.3F}) ==
        Rgb{0.1F, 0.2F, 0.3F});
}

TEST_CASE("scene textures: a checkerboard has color 0 where both squares are even or both odd", "[io][scene]") {
  const auto board = texture_of(R"({"type": "checkerboard", "color0": [1, 0, 0], "color1": [0, 1, 0]})");
  CHECK(board.evaluate(glint::Vec2<float>{0.25F, 0.25F}) == Rgb{1, 0, 0});
  CHECK(board.evaluate(glint::Vec2<float>{0.75F, 0.25F}) == Rgb{0, 1, 0});
  CHECK(board.evaluate(glint::Vec2<float>{0.75F, 0.75F}) == Rgb{1, 0, 0});
  const auto gray = texture_of(R"({"type": "checkerboard"})");
  CHECK(gray.evaluate(glint::Vec2<float>{0.25F, 0.25F}) == Rgb{0.4F});
  CHECK(gray.evaluate(glint::Vec2<float>{0.25F, 0.75F}) == Rgb{0.2F});
}

TEST_CASE("scene textures: coordinates are scaled, then shifted", "[io][scene]") {
  // scale · uv + delta = (2 · 0.3 + 0, 1 · 0.1 + 0.5) = (0.6, 0.6): squares 1 and 1. Unmapped: 0 and 0, then (0.6,
  // 0.1).
  const auto board = [](const char* mapping) {
    return texture_of(std::string(R"({"type": "checkerboard", "tex_coordinate_generator": )") + mapping + "}");
  };
  const auto mapped = board(R"({"type": "uvmapping2d", "scale": [2, 1], "delta": [0, 0.5]})");
  CHECK(mapped.evaluate(glint::Vec2<float>{0.3F, 0.1F}) == Rgb{0.4F});
  CHECK(mapped.evaluate(glint::Vec2<float>{0.2F, 0.1F}) == Rgb{0.2F});
  CHECK(board("{}").evaluate(glint::Vec2<float>{0.6F, 0.1F}) == Rgb{0.2F});
}

TEST_CASE("scene textures: row 0 of an image is at v = 0, and 8-bit images are sRGB unless said to be linear",
          "[io][scene]") {
  const TemporaryDirectory directory;
  glint::Image image({1, 2});
  image(0, 0) = {1, 0, 0};
  image(0, 1) = {0.5F, 0.5F, 0.5F};
  glint::write_exr(image, directory / "image.exr");
  const auto exr = texture_of(R"({"type": "image", "path": "image.exr"})", directory.path());
  CHECK(exr.evaluate(glint::Vec2<float>{0.5F, 0.25F}) == Rgb{1, 0, 0});
  CHECK(exr.evaluate(glint::Vec2<float>{0.5F, 0.75F}) == Rgb{0.5F});

  glint::write_png(image, directory / "image.png");
  const auto srgb = texture_of(R"({"type": "image", "path": "image.png"})", directory.path());
  CHECK(srgb.evaluate(glint::Vec2<float>{0.5F, 0.75F}).r == Approx(0.5).margin(0.005));  // 8 bits
  const auto linear = texture_of(R"({"type": "image", "path": "image.png", "encoding": "linear"})", directory.path());
  CHECK(linear.evaluate(glint::Vec2<float>{0.5F, 0.75F}).r ==
        Approx(0.7354).margin(0.005));  // 1.055 · 0.5^(1 / 2.4) − 0.055
}

TEST_CASE("scene textures: a wrong texture is an error that tells what was found and expected", "[io][scene]") {
  CHECK(texture_error("{}") == "/x: the key \"type\" is missing");
  CHECK(texture_error(R"({"type": "noise"})") ==
        "/x/type: found \"noise\", expected one of \"constant\", \"checkerboard\", \"image\"");
  CHECK(texture_error(R"({"type": "constant"})") == "/x: the key \"color\" is missing");
  CHECK(texture_error(R"({"type": "constant", "color": [1, 1]})") ==
        "/x/color: found an array of 2, expected an array of 3 numbers");
  CHECK(texture_error(R"({"type": "image"})") == "/x: the key \"path\" is missing");
  CHECK(texture_error(R"({"type": "image", "path": "no/such.exr"})") ==
        "/x/path: no/such.exr: cannot be read: No such file or directory");
  CHECK(
      texture_error(R"({"type": "image", "path": "a.gif"})").starts_with("/x/path: a.gif: cannot be read as an image"));
  CHECK(texture_error(R"({"type": "image", "path": "a.exr", "encoding": "gamma"})") ==
        "/x/encoding: found \"gamma\", expected one of \"srgb\", \"linear\"");
  CHECK(texture_error(R"({"type": "checkerboard", "tex_coordinate_generator": {"type": "spherical"}})") ==
        "/x/tex_coordinate_generator/type: found \"spherical\", expected one of \"uvmapping2d\"");
}

TEST_CASE("scene textures: all are known by their names", "[io][scene]") {
  JsonText json(R"({"b": {"type": "constant", "color": [1, 1, 1]}, "a": {"type": "checkerboard"}})");
  SceneDraft draft;
  glint::detail::read_textures(json.object(), draft);
  CHECK(draft.textures.size() == 2);
  CHECK(draft.textures.at("b").evaluate(glint::Vec2<float>{0, 0}) == Rgb{1});
}

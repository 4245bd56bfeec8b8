// SPDX-License-Identifier: MIT
#include <glint/io/scene_textures.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_scene_textures {

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
  CHECK(texture_error(R"({"type": "marble"})") ==
        "/x/type: found \"marble\", expected one of \"constant\", \"checkerboard\", \"image\", \"noise\", \"mix\", "
        "\"triplanar\"");
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

TEST_CASE("scene textures: an image has a filter, wraps, a scale and an offset", "[io][scene]") {
  const TemporaryDirectory directory;
  glint::Image pixels({2, 1});
  pixels(1, 0) = 1;  // black, white
  glint::write_exr(pixels, directory / "image.exr");
  const auto image = [&](const std::string& keys) {
    const auto texture = texture_of(R"({"type": "image", "path": "image.exr")" + keys + "}", directory.path());
    return [=](float u, float v) { return texture.evaluate(glint::Vec2<float>{u, v}).r; };
  };
  CHECK(image("")(0.5F, 0.5F) == 0.5F);  // bilinear, halfway between the two pixels
  CHECK(image(R"(, "filter": "bilinear")")(0.5F, 0.5F) == 0.5F);
  CHECK(image(R"(, "filter": "nearest")")(0.5F, 0.5F) == 1);
  CHECK(image("")(1.25F, 0.5F) == 0);                       // the black one again
  CHECK(image(R"(, "wrap": "clamp")")(1.25F, 0.5F) == 1);   // the last one
  CHECK(image(R"(, "wrap": "mirror")")(1.25F, 0.5F) == 1);  // its mirror image
  CHECK(image(R"(, "wrap": "border")")(1.3F, 0.5F) == 0);   // black
  CHECK(image(R"(, "wrap": "border")")(0.75F, 0.5F) == 1);  // but white inside
  CHECK(image(R"(, "wrap": ["clamp", "border"])")(9, 0.5F) == 1);
  CHECK(image(R"(, "wrap": ["clamp", "border"])")(9, 2) == 0);
  CHECK(image(R"(, "scale": [0.5, 1], "offset": [0.25, 0])")(1, 0.5F) ==
        1);  // 0.5 · 1 + 0.25 is the white one's center
}

TEST_CASE("scene textures: filtered images are averaged over footprints, and the scene knows", "[io][scene]") {
  const TemporaryDirectory directory;
  glint::Image pixels({2, 1});
  pixels(1, 0) = 1;
  glint::write_exr(pixels, directory / "image.exr");
  const auto draft_of = [&](const std::string& keys) {
    JsonText json(R"({"a": {"type": "image", "path": "image.exr")" + keys + "}}");
    json.source.path = directory / "scene.json";
    SceneDraft draft;
    glint::detail::read_textures(json.object(), draft);
    return draft;
  };
  const glint::UvFootprint wide{{100, 0}, {0, 100}};
  for (const std::string filter : {"trilinear", "ewa"}) {
    const SceneDraft draft = draft_of(", \"filter\": \"" + filter + "\"");
    const SceneTexture& texture = draft.textures.at("a");
    CHECK(texture.evaluate(glint::Vec2<float>{0.75F, 0.5F}).r == 1);  // a pixel
    CHECK(color_at(texture, {0.75F, 0.5F}, wide).r == Approx(0.5));   // the mean of both
    CHECK(draft.scene.filters_textures);
    CHECK(options_of(draft.scene).footprint == 1);
  }
  const SceneDraft plain = draft_of("");
  CHECK_FALSE(plain.scene.filters_textures);
  CHECK(options_of(plain.scene).footprint == 0);
  const SceneDraft round = draft_of(R"(, "filter": "ewa", "max_anisotropy": 1, "wrap": ["clamp", "border"])");
  const auto* const texture = round.textures.at("a").get_if<glint::FilteredImageTexture>();
  REQUIRE(texture != nullptr);
  CHECK(texture->max_anisotropy == 1);
  CHECK(texture->wrap_s == glint::Wrap::Clamp);
  CHECK(texture->wrap_t == glint::Wrap::Border);
}

TEST_CASE("scene textures: noise is the library's", "[io][scene]") {
  const glint::Surface at{.position = {0.3F, 1.7F, -2.2F}};
  CHECK(color_at(texture_of(R"({"type": "noise"})"), at) == glint::NoiseTexture{}.evaluate(at));
  const auto marble = texture_of(R"({"type": "noise", "pattern": "turbulence", "color0": [1, 0, 0],
      "color1": [0, 1, 0], "scale": [2, 3, 4], "offset": [5, 6, 7], "octaves": 2, "gain": 0.7, "lacunarity": 3,
      "seed": 9})");
  const glint::NoiseTexture expected{.color0 = {1, 0, 0},
                                     .color1 = {0, 1, 0},
                                     .scale = {2, 3, 4},
                                     .offset = {5, 6, 7},
                                     .octaves = {.count = 2, .gain = 0.7F, .lacunarity = 3, .seed = 9},
                                     .pattern = glint::NoisePattern::Turbulence};
  CHECK(color_at(marble, at) == expected.evaluate(at));
}

TEST_CASE("scene textures: mixtures and projections name other textures, in any order", "[io][scene]") {
  JsonText json(R"({"a": {"type": "mix", "texture0": "m", "texture1": "white", "share": "quarter"},
                    "m": {"type": "mix", "texture0": "black", "texture1": "white"},
                    "p": {"type": "triplanar", "texture_name": "board", "scale": 2},
                    "black": {"type": "constant", "color": [0, 0, 0]},
                    "board": {"type": "checkerboard", "color0": [1, 1, 1], "color1": [0, 0, 0]},
                    "quarter": {"type": "constant", "color": [0.25, 0.25, 0.25]},
                    "white": {"type": "constant", "color": [1, 1, 1]}})");
  SceneDraft draft;
  glint::detail::read_textures(json.object(), draft);
  CHECK(draft.textures.size() == 7);
  CHECK(draft.other_textures.empty());
  CHECK(color_at(draft.textures.at("m"), {}) == Rgb{0.5F});
  CHECK(color_at(draft.textures.at("a"), {}).r == Approx(0.625));  // 0.5 + 0.25 (1 − 0.5)
  // Seen along z at (x, y) = 2 (0.3, 0.1): squares 1 and 0, of which one is odd.
  const glint::Surface wall{.position = {0.3F, 0.1F, 5}, .normal = {0, 0, 1}};
  CHECK(color_at(draft.textures.at("p"), wall) == Rgb{0});
  CHECK(json.source.warnings.empty());
}

TEST_CASE("scene textures: wrong keys of the newer textures are errors", "[io][scene]") {
  CHECK(texture_error(R"({"type": "checkerboard", "scale": [1, 1], "tex_coordinate_generator": {}})") ==
        "/x/tex_coordinate_generator: stands beside \"scale\" or \"offset\", which say the same");
  CHECK(texture_error(R"({"type": "noise", "octaves": 0})") == "/x/octaves: found 0, expected an integer from 1 to 32");
  CHECK(texture_error(R"({"type": "noise", "gain": -1})") == "/x/gain: found -1, expected a number from 0 up");
  CHECK(texture_error(R"({"type": "noise", "lacunarity": 0})") == "/x/lacunarity: found 0, expected a number above 0");
  CHECK(texture_error(R"({"type": "noise", "pattern": "wood"})") ==
        "/x/pattern: found \"wood\", expected one of \"fbm\", \"turbulence\"");
  CHECK(texture_error(R"({"type": "mix", "texture1": "a"})") == "/x: the key \"texture0\" is missing");
  CHECK(texture_error(R"({"type": "triplanar"})") == "/x: the key \"texture_name\" is missing");
  const auto textures_error = [](const char* text) {
    return json_error(text, [](JsonObject object) {
      SceneDraft draft;
      glint::detail::read_textures(std::move(object), draft);
      return 0;
    });
  };
  CHECK(textures_error(R"({"a": {"type": "mix", "texture0": "b", "texture1": "b"},
                           "b": {"type": "triplanar", "texture_name": "a"}})") ==
        "/x/b/texture_name: the texture \"a\" is made of itself");
  CHECK(textures_error(R"({"gray": {"type": "constant", "color": [1, 1, 1]},
                           "a": {"type": "triplanar", "texture_name": "grey"}})") ==
        "/x/a/texture_name: there is no texture named \"grey\"; did you mean \"gray\"?");
  CHECK(textures_error(R"({"a": {"type": "mix", "texture0": "c", "texture1": "c", "share": 2},
                           "c": {"type": "checkerboard"}})") ==
        "/x/a/share: found 2, expected a number from 0 to 1, or the name of a texture");
}

TEST_CASE("scene textures: a wrong filter or wrap is an error", "[io][scene]") {
  const TemporaryDirectory directory;
  glint::write_exr(glint::Image({1, 1}), directory / "i.exr");
  const auto error = [&](const std::string& keys) {
    return json_error((R"({"type": "image", "path": ")" + (directory / "i.exr").string() + "\"" + keys + "}").c_str(),
                      [](JsonObject object) {
                        SceneDraft draft;
                        return glint::detail::read_texture(std::move(object), draft);
                      });
  };
  CHECK(error(R"(, "wrap": "tile")") ==
        "/x/wrap: found \"tile\", expected one of \"repeat\", \"clamp\", \"mirror\", \"border\"");
  CHECK(error(R"(, "wrap": ["clamp"])") == "/x/wrap: found an array of 1, expected a name, or an array of 2");
  CHECK(error(R"(, "filter": "ewa", "max_anisotropy": 0.5)") ==
        "/x/max_anisotropy: found 0.5, expected a number from 1 to 64");
  CHECK(error(R"(, "filter": "cubic")").starts_with("/x/filter: found \"cubic\", expected one of \"nearest\""));
}

}  // namespace test_io_scene_textures

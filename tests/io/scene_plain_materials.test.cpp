// SPDX-License-Identifier: MIT
#include <glint/io/scene_plain_materials.hpp>  // first, so the header proves it stands alone

#include <string>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace test_io_scene_plain_materials {

namespace {

using glint::JsonObject;
using glint::Principled;
using glint::Rgb;
using glint::ScenePlainMaterial;
using glint::detail::MaterialKind;
using glint::detail::SceneDraft;
using glint::testing::json_error;
using glint::testing::JsonText;

SceneDraft draft_with_grey() {
  SceneDraft draft;
  draft.textures.emplace("grey", glint::ConstantTexture{Rgb{0.5F}});
  return draft;
}

ScenePlainMaterial plain(MaterialKind kind, const char* text) {
  JsonText json(text);
  JsonObject object = json.object("/x");
  ScenePlainMaterial result = glint::detail::read_plain_material(kind, object, draft_with_grey());
  object.finish();
  CHECK(json.source.warnings.empty());
  return result;
}

std::string principled_error(const char* text) {
  return json_error(text, [](JsonObject object) {
    return glint::detail::read_plain_material(MaterialKind::Principled, object, draft_with_grey());
  });
}

Principled principled(const char* text) {
  return plain(MaterialKind::Principled, text).get_if<glint::ScenePrincipled>()->bsdf({});
}

}  // namespace

TEST_CASE("scene plain materials: a principled material has the library's defaults", "[io][scene]") {
  CHECK(principled("{}") == Principled{});
}

TEST_CASE("scene plain materials: each number of a principled material has a key of its name", "[io][scene]") {
  CHECK(principled(R"({"base_color": [0.1, 0.2, 0.3], "metallic": 0.1, "roughness": 0.2, "anisotropy": 0.3, "eta": 1.4,
    "transmission": 0.4, "coat": 0.6, "coat_roughness": 0.7, "sheen": 0.8, "sheen_roughness": 0.9,
    "sheen_tint": 1})") == Principled{.base_color = {0.1F, 0.2F, 0.3F},
                                      .metallic = 0.1F,
                                      .roughness = 0.2F,
                                      .anisotropy = 0.3F,
                                      .eta = 1.4F,
                                      .transmission = 0.4F,
                                      .coat = 0.6F,
                                      .coat_roughness = 0.7F,
                                      .sheen = 0.8F,
                                      .sheen_roughness = 0.9F,
                                      .sheen_tint = 1});
}

TEST_CASE("scene plain materials: textures may stand for the color and for numbers", "[io][scene]") {
  const Principled textured = principled(R"({"base_color": "grey", "roughness": "grey", "coat": "grey"})");
  CHECK(textured.base_color == Rgb{0.5F});
  CHECK(textured.roughness == Approx(0.5F));
  CHECK(textured.coat == Approx(0.5F));
}

TEST_CASE("scene plain materials: plastic may be rough", "[io][scene]") {
  const auto plastic = plain(MaterialKind::RoughPlastic,
                             R"({"texture_name": "grey", "distribution": "ggx", "alpha_x": 0.3, "eta": 1.4})");
  const auto* rough = plastic.get_if<glint::SceneRoughPlastic<glint::Ggx>>();
  REQUIRE(rough != nullptr);
  CHECK(rough->bsdf({}) == glint::RoughCoatedDiffuse<glint::Ggx>{Rgb{0.5F}, {0.3F, 0.1F}, 1.4F});
}

TEST_CASE("scene plain materials: wrong numbers and names are errors", "[io][scene]") {
  CHECK(principled_error(R"({"metallic": 2})") ==
        "/x/metallic: found 2, expected a number from 0 to 1, or the name of a texture");
  CHECK(principled_error(R"({"roughness": "gray"})") ==
        "/x/roughness: there is no texture named \"gray\"; did you mean \"grey\"?");
  CHECK(principled_error(R"({"eta": 1})") == "/x/eta: found 1, expected a number from 1.03 to 3");
}

}  // namespace test_io_scene_plain_materials

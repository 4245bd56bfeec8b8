// SPDX-License-Identifier: MIT
#include <glint/io/scene_materials.hpp>  // first, so the header proves it stands alone

#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/json_text.hpp>

namespace {

using glint::JsonObject;
using glint::Rgb;
using glint::SceneMaterial;
using glint::Vec3;
using glint::detail::SceneDraft;
using glint::testing::json_error;
using glint::testing::JsonText;

SceneDraft draft_with_grey() {
  SceneDraft draft;
  draft.textures.emplace("grey", glint::ConstantTexture{0.5F});
  return draft;
}

SceneMaterial material_of(const char* text, std::vector<std::string> warnings = {}) {
  JsonText json(text);
  auto material = glint::detail::read_material(json.object("/materials/m"), draft_with_grey());
  CHECK(json.source.warnings == warnings);
  return material;
}

std::string material_error(const char* text) {
  return json_error(
      text, [](JsonObject object) { return glint::detail::read_material(std::move(object), draft_with_grey()); });
}

Rgb evaluated(const SceneMaterial& material, const Vec3<float>& wo, const Vec3<float>& wi) {
  return glint::bsdf_at(material, glint::Surface{}, 0).evaluate(wo, wi);
}

const Vec3<float> up{0.0F, 0.0F, 1.0F};
const Vec3<float> down{0.0F, 0.0F, -1.0F};

}  // namespace

TEST_CASE("scene materials: diffuse reflects albedo / pi on the front alone, unless two-sided", "[io][scene]") {
  const auto one_sided = material_of(R"({"texture_name": "grey"})");
  CHECK(evaluated(one_sided, up, up).r == Approx(0.5 / 3.14159265));
  CHECK(evaluated(one_sided, down, down) == Rgb{0});
  CHECK(evaluated(one_sided, up, down) == Rgb{0});
  const auto two_sided = material_of(R"({"type": "diffuse", "texture_name": "grey", "twosided": true})");
  CHECK(evaluated(two_sided, down, down).r == Approx(0.5 / 3.14159265));
  CHECK(evaluated(two_sided, up, down) == Rgb{0});
}

TEST_CASE("scene materials: eta is the index inside over that outside", "[io][scene]") {
  const auto material = material_of(R"({"type": "refraction", "eta": 2})");
  REQUIRE(material.get_if<glint::PerfectRefraction>() != nullptr);
  // Snell: sin 60° = 2 · sin θ inside, on the way in.
  const float sine = 0.8660254F;
  const auto sample = material.get_if<glint::PerfectRefraction>()->sample({sine, 0, 0.5F}, 0, {0, 0});
  REQUIRE(sample);
  CHECK(sample->wi.x == Approx(-sine / 2));
  CHECK(sample->wi.z < 0);
  CHECK(material_of(R"({"type": "refraction"})").get_if<glint::PerfectRefraction>()->eta == 1.5F);
}

TEST_CASE("scene materials: glass and mirrors", "[io][scene]") {
  CHECK(*material_of(R"({"type": "glass"})").get_if<glint::Dielectric>() == glint::Dielectric{1, 1, 1.5F});
  CHECK(*material_of(R"({"type": "glass", "R": [1, 0, 0], "T": [0, 1, 0], "eta": 1.3})").get_if<glint::Dielectric>() ==
        glint::Dielectric{{1, 0, 0}, {0, 1, 0}, 1.3F});
  CHECK(*material_of(R"({"type": "mirror"})").get_if<glint::Mirror>() == glint::Mirror{1});
  CHECK(*material_of(R"({"type": "mirror", "R": [1, 0, 0.5]})").get_if<glint::Mirror>() == glint::Mirror{{1, 0, 0.5F}});
}

TEST_CASE("scene materials: a rough conductor is seen from outside, (etaT + i k) / etaI", "[io][scene]") {
  const auto material = material_of(R"({"type": "roughconductor", "texture_name": "grey", "alpha_x": 0.2,
    "etaI": [2, 2, 2], "etaT": [3, 4, 5], "k": [6, 7, 8]})");
  const auto* conductor = material.get_if<glint::SceneRoughConductor<glint::Beckmann>>();
  REQUIRE(conductor != nullptr);
  CHECK(conductor->base.eta == Rgb{1.5F, 2, 2.5F});
  CHECK(conductor->base.k == Rgb{3, 3.5F, 4});
  CHECK(conductor->base.distribution == glint::Beckmann{0.2F, 0.1F});
  CHECK(conductor->texture.evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.5F});
}

TEST_CASE("scene materials: facets may be spread in two ways, and give back what they hide", "[io][scene]") {
  const auto ggx = material_of(R"({"type": "roughconductor", "metal": "gold", "distribution": "ggx", "alpha_x": 0.3})");
  const auto* rough = ggx.get_if<glint::SceneRoughConductor<glint::Ggx>>();
  REQUIRE(rough != nullptr);
  CHECK(rough->base.distribution == glint::Ggx{0.3F, 0.1F});
  CHECK(rough->base.eta == glint::metals::gold.eta);
  CHECK(rough->base.k == glint::metals::gold.k);
  CHECK(rough->texture.evaluate(glint::Vec2<float>{0, 0}) == Rgb{1});
  const auto whole = material_of(R"({"type": "roughconductor", "metal": "iron", "compensated": true})");
  REQUIRE(whole.get_if<glint::SceneCompensatedConductor<glint::Beckmann>>() != nullptr);
  CHECK(whole.get_if<glint::SceneCompensatedConductor<glint::Beckmann>>()->base.k == glint::metals::iron.k);
  const auto glass = material_of(R"({"type": "roughglass", "distribution": "ggx", "alpha_y": 0.2, "T": [1, 0, 1]})");
  REQUIRE(glass.get_if<glint::RoughDielectric<glint::Ggx>>() != nullptr);
  CHECK(*glass.get_if<glint::RoughDielectric<glint::Ggx>>() ==
        glint::RoughDielectric<glint::Ggx>{1, {1, 0, 1}, {0.1F, 0.2F}, 1.5F});
  CHECK(material_of(R"({"type": "roughglass"})").get_if<glint::RoughDielectric<glint::Beckmann>>() != nullptr);
}

TEST_CASE("scene materials: clay, plastic, panes and polished metal", "[io][scene]") {
  const auto clay = material_of(R"({"texture_name": "grey", "roughness": 0.5})");
  REQUIRE(clay.get_if<glint::SceneRoughDiffuse>() != nullptr);
  CHECK(clay.get_if<glint::SceneRoughDiffuse>()->base.roughness == 0.5F);
  CHECK(evaluated(clay, down, down) == Rgb{0});
  CHECK(evaluated(material_of(R"({"texture_name": "grey", "roughness": 1, "twosided": true})"), down, down).r > 0);
  const auto plastic = material_of(R"({"type": "plastic", "texture_name": "grey", "eta": 1.4})");
  REQUIRE(plastic.get_if<glint::ScenePlastic>() != nullptr);
  CHECK(plastic.get_if<glint::ScenePlastic>()->base.eta == 1.4F);
  CHECK(*material_of(R"({"type": "thinglass", "R": [1, 0, 0]})").get_if<glint::ThinDielectric>() ==
        glint::ThinDielectric{{1, 0, 0}, 1, 1.5F});
  const auto silver = material_of(R"({"type": "conductor", "metal": "silver", "texture_name": "grey"})");
  REQUIRE(silver.get_if<glint::SceneConductor>() != nullptr);
  CHECK(silver.get_if<glint::SceneConductor>()->base.eta == glint::metals::silver.eta);
  CHECK(silver.get_if<glint::SceneConductor>()->texture.evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.5F});
}

TEST_CASE("scene materials: legacy colors are accepted with a warning", "[io][scene]") {
  const auto diffuse =
      material_of(R"({"type": "diffuse", "color": [1, 0, 0]})",
                  {"scene.json:/materials/m/color: legacy spelling, better: a constant texture named in "
                   "\"texture_name\""});
  CHECK(evaluated(diffuse, up, up).r == Approx(1 / 3.14159265));
  const auto conductor = material_of(R"({"type": "roughconductor", "R": [0, 1, 0]})",
                                     {"scene.json:/materials/m/R: legacy spelling, better: a constant texture named in "
                                      "\"texture_name\""});
  REQUIRE(conductor.get_if<glint::SceneRoughConductor<glint::Beckmann>>() != nullptr);
  CHECK(conductor.get_if<glint::SceneRoughConductor<glint::Beckmann>>()->texture.evaluate(glint::Vec2<float>{0, 0}) ==
        Rgb{0, 1, 0});
  const auto both = material_of(R"({"color": [1, 0, 0], "texture_name": "grey"})",
                                {"scene.json:/materials/m/color: has no effect beside \"texture_name\""});
  CHECK(evaluated(both, up, up).g == Approx(0.5 / 3.14159265));
}

TEST_CASE("scene materials: a wrong material is an error that tells what was found and expected", "[io][scene]") {
  CHECK(material_error("{}") == "/x: the key \"texture_name\" is missing");
  CHECK(material_error(R"({"texture_name": "gray"})") ==
        "/x/texture_name: there is no texture named \"gray\"; did you mean \"grey\"?");
  CHECK(material_error(R"({"type": "glas"})") ==
        "/x/type: found \"glas\", expected one of \"diffuse\", \"plastic\", \"refraction\", \"glass\", "
        "\"thinglass\", \"roughglass\", \"mirror\", \"conductor\", \"roughconductor\"; did you mean \"glass\"?");
  CHECK(material_error(R"({"type": "refraction", "eta": 0})") == "/x/eta: found 0, expected a number above 0");
  CHECK(material_error(R"({"texture_name": "grey", "twosided": 1})") == "/x/twosided: found 1, expected true or false");
  CHECK(material_error(R"({"type": "roughconductor", "texture_name": "grey", "alpha_y": -1})") ==
        "/x/alpha_y: found -1, expected a number above 0");
  CHECK(material_error(R"({"type": "roughconductor", "texture_name": "grey", "etaI": [0, 1, 1]})") ==
        "/x/etaI: found [0,1,1], expected numbers above 0");
  CHECK(material_error(R"({"texture_name": "grey", "roughness": 2})") ==
        "/x/roughness: found 2, expected a number from 0 to 1");
  CHECK(material_error(R"({"type": "plastic", "texture_name": "grey", "eta": 1})") ==
        "/x/eta: found 1, expected a number from 1.03 to 3");
  CHECK(material_error(R"({"type": "conductor", "metal": "gild"})") ==
        "/x/metal: found \"gild\", expected one of \"aluminum\", \"chromium\", \"copper\", \"gold\", \"iron\", "
        "\"silver\", \"titanium\", \"tungsten\"; did you mean \"gold\"?");
  CHECK(material_error(R"({"type": "conductor", "metal": "gold", "k": [1, 1, 1]})") ==
        "/x: a metal is given either by \"metal\" or by \"etaI\", \"etaT\" and \"k\"");
  CHECK(material_error(R"({"type": "roughglass", "distribution": "gauss"})") ==
        "/x/distribution: found \"gauss\", expected one of \"beckmann\", \"ggx\"");
  CHECK(material_error(R"({"type": "glass", "R": 1})") == "/x/R: found 1, expected an array of 3 numbers");
}

TEST_CASE("scene materials: all are known by their names", "[io][scene]") {
  JsonText json(R"({"b": {"type": "mirror"}, "a": {"texture_name": "grey"}})");
  SceneDraft draft = draft_with_grey();
  glint::detail::read_materials(json.object(), draft);
  REQUIRE(draft.materials.size() == 2);
  CHECK(draft.scene.materials[draft.materials.at("b")].get_if<glint::Mirror>() != nullptr);
  CHECK(draft.scene.materials[draft.materials.at("a")].get_if<glint::SceneDiffuse>() != nullptr);
}

// SPDX-License-Identifier: MIT
#include <glint/io/scene_materials.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <support/catch.hpp>
#include <support/json_text.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_scene_materials {

namespace {

using glint::Rgb;
using glint::SceneMaterial;
using glint::Vec3;
using glint::detail::SceneDraft;
using glint::testing::JsonText;
using glint::testing::message_of;

SceneDraft draft_with_grey() {
  SceneDraft draft;
  draft.textures.emplace("grey", glint::ConstantTexture{0.5F});
  return draft;
}

SceneMaterial material_of(const char* text, std::vector<std::string> warnings = {}) {
  JsonText json(text);
  auto read = glint::detail::read_material(json.value("/materials/m"), draft_with_grey());
  CHECK(json.source.warnings == warnings);
  return std::move(read.material);
}

std::string material_error(const char* text) {
  JsonText json(text);
  return message_of<glint::IoError>([&] { (void)glint::detail::read_material(json.value("/x"), draft_with_grey()); },
                                    "scene.json:");
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
        "/x/type: found \"glas\", expected one of \"diffuse\", \"plastic\", \"roughplastic\", "
        "\"principled\", \"refraction\", \"glass\", \"thinglass\", \"roughglass\", \"mirror\", \"conductor\", "
        "\"roughconductor\", \"blend\"; did you mean \"glass\"?");
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

TEST_CASE("scene materials: any may be two-sided", "[io][scene]") {
  const auto plastic = material_of(R"({"type": "roughplastic", "texture_name": "grey", "twosided": true})");
  REQUIRE(plastic.get_if<glint::SceneLayer>() != nullptr);
  CHECK(evaluated(plastic, down, down).r > 0);
  CHECK(evaluated(plastic, down, down) == evaluated(plastic, up, up));
}

TEST_CASE("scene materials: normals are bent by a map or by heights", "[io][scene]") {
  SceneDraft draft = draft_with_grey();
  draft.textures.emplace("slope", glint::ConstantTexture{{1.0F, 0.5F, 1.0F}});  // 45° toward x
  auto image = std::make_shared<const glint::Image>(glint::Vec2i{8, 4});
  draft.textures.emplace("heights", glint::ImageTexture{.image = image});
  const auto read = [&](const char* text) {
    JsonText json(text);
    return glint::detail::read_material(json.value("/x"), draft).material;
  };
  const auto bent = read(R"({"texture_name": "grey", "normal_map": "slope"})");
  const glint::Surface at{.tangent = {1, 0, 0}};
  const auto bsdf = glint::bsdf_at(bent, at, 0);
  const auto* perturbed = bsdf.get_if<glint::Perturbed<glint::SceneLayerBsdf>>();
  REQUIRE(perturbed != nullptr);
  CHECK(perturbed->normal().x == Approx(std::sqrt(0.5)));
  const auto rough = read(R"({"texture_name": "grey", "bump_map": "heights", "bump_scale": 0.25})");
  const auto* bumps = rough.get_if<glint::SceneBumpMapped>();
  REQUIRE(bumps != nullptr);
  CHECK(bumps->scale == 0.25F);
  CHECK(bumps->step == 0.125F);  // one of 8 pixels
  CHECK(material_error(R"({"texture_name": "grey", "bump_map": "grey", "normal_map": "grey"})") ==
        "/x: a surface is bent either by \"normal_map\" or by \"bump_map\"");
}

TEST_CASE("scene materials: a blend is made of others, before or after it", "[io][scene]") {
  JsonText json(R"({"a": {"type": "blend", "material0": "b", "material1": "z", "share": 0.25},
    "b": {"texture_name": "grey"}, "z": {"type": "mirror"}})");
  SceneDraft draft = draft_with_grey();
  glint::detail::read_materials(json.object(), draft);
  const auto& blend = draft.scene.materials[draft.materials.at("a")];
  REQUIRE(blend.get_if<glint::SceneBlend>() != nullptr);
  CHECK(evaluated(blend, up, up).r == Approx(0.75 * 0.5 / 3.14159265));  // the mirror's share is seen nowhere
}

TEST_CASE("scene materials: what a blend cannot have is an error", "[io][scene]") {
  const auto error = [](const char* text) {
    JsonText json(text);
    SceneDraft draft = draft_with_grey();
    return message_of<glint::IoError>([&] { glint::detail::read_materials(json.object(), draft); }, "scene.json:");
  };
  CHECK(error(R"({"a": {"type": "blend", "material0": "b", "material1": "b"},
                  "b": {"texture_name": "grey", "opacity": 0.5}})") ==
        "/a/material0: the material \"b\" is a blend, or has \"normal_map\", \"bump_map\" or \"opacity\", which what "
        "is blended cannot have");
  CHECK(error(R"({"a": {"type": "blend", "material0": "c", "material1": "b"}, "b": {"texture_name": "grey"}})") ==
        "/a/material0: there is no material named \"c\"; did you mean \"b\"?");
}

TEST_CASE("scene materials: opacity is a number or a texture", "[io][scene]") {
  JsonText json(R"({"a": {"type": "mirror", "opacity": 0.25}, "b": {"type": "mirror"},
    "c": {"type": "mirror", "opacity": "grey"}})");
  SceneDraft draft = draft_with_grey();
  glint::detail::read_materials(json.object(), draft);
  const auto opacity = [&](const char* name) {
    return draft.scene.opacities.at(draft.opacity_of_material.at(draft.materials.at(name)));
  };
  CHECK(opacity("a").evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.25F});
  CHECK(opacity("c").evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.5F});
  CHECK(draft.opacity_of_material.size() == 2);
  CHECK(material_error(R"({"type": "mirror", "opacity": 2})") ==
        "/x/opacity: found 2, expected a number from 0 to 1, or the name of a texture");
}

}  // namespace test_io_scene_materials

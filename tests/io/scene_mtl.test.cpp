// SPDX-License-Identifier: MIT
#include <glint/io/scene_mtl.hpp>  // first, so the header proves it stands alone

#include <cmath>
#include <string>
#include <vector>

#include <support/catch.hpp>
#include <support/temporary_directory.hpp>

namespace test_io_scene_mtl {

namespace {

using glint::JsonSource;
using glint::ObjMaterial;
using glint::Rgb;
using glint::SceneMaterial;
using glint::detail::SceneDraft;
using glint::testing::message_of;
using glint::testing::TemporaryDirectory;

/// One material in a scene.
struct Added {
  SceneDraft draft{};
  JsonSource source{};

  explicit Added(const ObjMaterial& material) { (void)glint::detail::MtlMaterials(draft, source).add(material); }

  [[nodiscard]] const SceneMaterial& material() const { return draft.scene.materials.at(0); }
  [[nodiscard]] glint::ScenePrincipled principled() const {
    return *material().get_if<glint::SceneLayer>()->material.get_if<glint::ScenePrincipled>();
  }
};

}  // namespace

TEST_CASE("scene mtl: a diffuse color alone is diffuse, on both sides", "[io][scene]") {
  const Added added({.diffuse = {0.1F, 0.2F, 0.3F}});
  const auto* diffuse = added.material().get_if<glint::TwoSidedMaterial<glint::SceneDiffuse>>();
  REQUIRE(diffuse != nullptr);
  CHECK(diffuse->front.texture.evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.1F, 0.2F, 0.3F});
}

TEST_CASE("scene mtl: specular colors make highlights as wide as the exponent says", "[io][scene]") {
  const auto shiny = Added({.diffuse = Rgb{0.5F}, .specular = Rgb{0.2F}, .shininess = 30, .ior = 1.6F}).principled();
  // alpha² = 2 / 32, alpha = 1/4, roughness² = alpha.
  CHECK(shiny.base.roughness == Approx(0.5F));
  CHECK(shiny.base.eta == 1.6F);
  CHECK(shiny.base.metallic == 0);
  // Illumination model 1 has no highlights.
  CHECK(Added({.specular = Rgb{1}, .illumination = 1}).material().get_if<glint::SceneLayer>() == nullptr);
}

TEST_CASE("scene mtl: specular without diffuse is metal, and so is Pm", "[io][scene]") {
  const auto mirror = Added({.specular = {0.9F, 0.5F, 0.1F}, .shininess = 1000}).principled();
  CHECK(mirror.bsdf({}).base_color == Rgb{0.9F, 0.5F, 0.1F});
  CHECK(mirror.base.metallic == 1);
  const auto metal = Added({.diffuse = Rgb{0.5F}, .roughness = 0.3F, .metallic = 1}).principled();
  CHECK(metal.bsdf({}).base_color == Rgb{0.5F});
  CHECK(metal.base.roughness == 0.3F);
  CHECK(metal.base.metallic == 1);
}

TEST_CASE("scene mtl: illumination models that refract are glass", "[io][scene]") {
  for (const int model : {4, 6, 7, 9}) {
    const Added added({.transmission = {1, 0.5F, 0}, .ior = 1.4F, .opacity = 0.1F, .illumination = model});
    REQUIRE(added.material().get_if<glint::Dielectric>() != nullptr);
    CHECK(*added.material().get_if<glint::Dielectric>() ==
          glint::Dielectric{.transmittance = {1, 0.5F, 0}, .eta = 1.4F});
    CHECK(added.draft.opacity_of_material.empty());
  }
  CHECK(*Added({.illumination = 7}).material().get_if<glint::Dielectric>() == glint::Dielectric{});
}

TEST_CASE("scene mtl: what dissolves lets light pass, unless it shines", "[io][scene]") {
  const Added pane({.opacity = 0.25F});
  REQUIRE(pane.draft.scene.opacities.size() == 1);
  CHECK(pane.draft.scene.opacities[0].evaluate(glint::Vec2<float>{0, 0}) == Rgb{0.25F});
  const Added lamp({.name = "lamp", .emission = Rgb{1}, .opacity = 0.25F});
  CHECK(lamp.draft.scene.opacities.empty());
  CHECK(lamp.source.warnings == std::vector<std::string>{"the material \"lamp\" of an MTL file: shines, and so is "
                                                         "opaque"});
}

TEST_CASE("scene mtl: maps are read once, upside down, and normals bend", "[io][scene]") {
  const TemporaryDirectory directory;
  glint::Image image({1, 2});
  image(0, 0) = Rgb{1};
  write_exr(image, directory / "map.exr");
  const auto map = directory / "map.exr";
  SceneDraft draft;
  JsonSource source;
  glint::detail::MtlMaterials materials(draft, source);
  CHECK(materials.add({.opacity_map = map, .normal_map = map}) == 0);
  CHECK(materials.add({.bump_map = map}) == 1);
  CHECK(draft.scene.materials[0].get_if<glint::SceneNormalMapped>() != nullptr);
  CHECK(draft.scene.materials[1].get_if<glint::SceneBumpMapped>() != nullptr);
  REQUIRE(draft.scene.opacities.size() == 1);
  CHECK(draft.scene.opacities[0].evaluate(glint::Vec2<float>{0.5F, 0.75F}) == Rgb{1});  // the top row
  CHECK(draft.scene.inputs == std::vector{map});
}

TEST_CASE("scene mtl: a map that is not there is an error that names it", "[io][scene]") {
  CHECK(message_of<glint::IoError>([] { Added({.diffuse_map = "no/such.png"}); }) ==
        "no/such.png: cannot be read: No such file or directory");
}

TEST_CASE("scene mtl: maps without effect are warned of", "[io][scene]") {
  CHECK(Added({.name = "m", .specular_map = "s.png", .emission_map = "e.png"}).source.warnings ==
        std::vector<std::string>{"the material \"m\" of an MTL file: map_Ks has no effect",
                                 "the material \"m\" of an MTL file: map_Ke has no effect"});
}

}  // namespace test_io_scene_mtl

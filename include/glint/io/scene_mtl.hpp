// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include <glint/color/image.hpp>
#include <glint/color/rgb.hpp>
#include <glint/io/image.hpp>
#include <glint/io/json_object.hpp>
#include <glint/io/mesh_obj.hpp>
#include <glint/io/scene_draft.hpp>
#include <glint/io/scene_materials.hpp>
#include <glint/io/scene_surfaces.hpp>

/// Materials of MTL files on their way into a scene.
namespace glint::detail {

/// Glass, by the illumination models that refract.
[[nodiscard]] inline bool is_glass(const ObjMaterial& m) noexcept {
  return m.illumination == 4 || m.illumination == 6 || m.illumination == 7 || m.illumination == 9;
}

/// Ni, where it is the index of something solid; 1.5 where it is left out, which reads as 1.
[[nodiscard]] inline float index_of(const ObjMaterial& m) noexcept {
  return m.ior >= 1.03F && m.ior <= 3 ? m.ior : 1.5F;
}

/// Pr, or what gives highlights of the size that the Phong exponent Ns does: alpha² = 2 / (Ns + 2).
///
/// Source: Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007, section 5.2.
[[nodiscard]] inline float roughness_of(const ObjMaterial& m) noexcept {
  return m.roughness > 0 ? std::min(m.roughness, 1.0F) : std::pow(2.0F / (2.0F + std::max(0.0F, m.shininess)), 0.25F);
}

/// Adds materials of one MTL file to a scene. Each image is read once.
class MtlMaterials {
 public:
  MtlMaterials(SceneDraft& draft, JsonSource& source) : draft_(draft), source_(source) {}

  /// The index of the material in the scene.
  [[nodiscard]] std::uint32_t add(const ObjMaterial& m) {
    if (!m.specular_map.empty()) warn(m, "map_Ks has no effect");
    if (!m.emission_map.empty()) warn(m, "map_Ke has no effect");
    const SceneLayer layer{plain(m), !is_glass(m)};
    SceneMaterial material = bent(m, layer);
    if (is_glass(m) || !lets_light_pass(m)) return draft_.add_material(std::move(material));
    if (!is_black(m.emission)) {
      warn(m, "shines, and so is opaque");
      return draft_.add_material(std::move(material));
    }
    SceneTexture opacity =
        m.opacity_map.empty() ? SceneTexture(ConstantTexture{Rgb{m.opacity}}) : image(m.opacity_map, Encoding::Linear);
    return draft_.add_material(std::move(material), std::move(opacity));
  }

 private:
  [[nodiscard]] static bool lets_light_pass(const ObjMaterial& m) noexcept {
    return m.opacity < 1 || !m.opacity_map.empty();
  }

  [[nodiscard]] ScenePlainMaterial plain(const ObjMaterial& m) {
    if (is_glass(m)) {
      return Dielectric{.transmittance = is_black(m.transmission) ? Rgb{1} : m.transmission, .eta = index_of(m)};
    }
    const bool shiny = !is_black(m.specular) && m.illumination != 1;
    if (!shiny && !(m.roughness > 0) && !(m.metallic > 0)) return SceneDiffuse{.texture = diffuse(m)};
    ScenePrincipled result{.base_color = diffuse(m)};
    result.base.roughness = roughness_of(m);
    result.base.metallic = std::min(std::max(0.0F, m.metallic), 1.0F);
    result.base.eta = index_of(m);
    if (shiny && is_black(m.diffuse) && m.diffuse_map.empty()) {
      result.base_color = ConstantTexture{m.specular};
      result.base.metallic = 1;
    }
    return result;
  }

  [[nodiscard]] SceneMaterial bent(const ObjMaterial& m, const SceneLayer& layer) {
    if (!m.normal_map.empty()) return SceneNormalMapped{layer, image(m.normal_map, Encoding::Linear)};
    if (!m.bump_map.empty()) return bump_mapped(layer, image(m.bump_map, Encoding::Linear), 1);
    return material_of(layer);
  }

  [[nodiscard]] SceneTexture diffuse(const ObjMaterial& m) {
    return m.diffuse_map.empty() ? SceneTexture(ConstantTexture{m.diffuse}) : image(m.diffuse_map, Encoding::Srgb);
  }

  /// In MTL files v = 0 is an image's bottom row.
  [[nodiscard]] SceneTexture image(const std::filesystem::path& path, Encoding encoding) {
    auto& known = images_[{path, encoding}];
    if (!known) {
      draft_.scene.inputs.push_back(path);
      known = std::make_shared<const Image>(read_image(path, encoding));
    }
    return ImageTexture{.image = known, .mapping = {.scale = {1, -1}, .delta = {0, 1}}};
  }

  void warn(const ObjMaterial& m, const std::string& problem) {
    source_.warnings.push_back("the material \"" + m.name + "\" of an MTL file: " + problem);
  }

  SceneDraft& draft_;
  JsonSource& source_;
  std::map<std::pair<std::filesystem::path, Encoding>, std::shared_ptr<const Image>> images_;
};

}  // namespace glint::detail

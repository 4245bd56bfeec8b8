// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/disk.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/io/scene_surfaces.hpp>
#include <glint/light/area.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/lights.hpp>
#include <glint/light/point.hpp>
#include <glint/light/spot.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/opacity.hpp>
#include <glint/render/options.hpp>
#include <glint/scene/scene.hpp>

namespace glint {

/// What the lights of a scene file can be.
using SceneLight = OneOf<PointLight, SpotLight, DirectionalLight, AreaLight<Triangle<float>>, AreaLight<Sphere<float>>,
                         AreaLight<Disk<float>>, AreaLight<Quad<float>>, EnvironmentLight<SceneTexture>>;

/// Primitives of one kind and, for each, what it is made of and which light it is.
struct PrimitiveAttributes {
  std::vector<std::uint32_t> materials;
  std::vector<std::uint32_t> lights;
};

/// A scene as it was read: all that rendering needs, owned here.
struct SceneFile {
  MeshBuffers<float> mesh;  ///< all meshes, in world space
  std::vector<Sphere<float>> spheres;
  std::vector<Disk<float>> disks;
  std::vector<Quad<float>> quads;
  std::array<PrimitiveAttributes, 4> attributes;  ///< of triangles, spheres, disks, quads

  std::vector<SceneMaterial> materials;
  std::vector<SceneLight> lights;
  std::vector<SceneTexture> opacities;              ///< of what lets light pass
  std::vector<std::uint32_t> opacity_of_primitive;  ///< as in Opacity; empty where everything is opaque
  bool filters_textures = false;  ///< whether there is an image that is filtered: else paths need no footprints

  SceneCamera camera;
  FilmSettings film;
  IntegratorSettings integrator;
  SamplerSettings sampler;
  AcceleratorSettings accelerator;
  std::vector<std::string> warnings;
  std::vector<std::filesystem::path> inputs;  ///< every file that was read

  [[nodiscard]] std::size_t triangle_count() const noexcept { return mesh.indices.size() / 3; }

  /// Every primitive, in the order triangles, spheres, disks, quads: views of this object's vectors.
  [[nodiscard]] auto shapes() const { return Joined{view(mesh), Elements{spheres}, Elements{disks}, Elements{quads}}; }
};

using SceneShapes = decltype(std::declval<const SceneFile&>().shapes());
using SceneBvh = Bvh<SceneShapes>;
using LoadedScene = Scene<SceneBvh, MaterialTable<SceneMaterial>, SceneLight>;

/// The same for scenes with something that is not opaque: a type of its own, so that others do not pay for it.
using MaskedSceneShapes = Filtered<SceneShapes, Opacity<SceneShapes, SceneTexture>>;
using MaskedScene = Scene<Bvh<MaskedSceneShapes>, MaterialTable<SceneMaterial>, SceneLight>;
using AnyLoadedScene = OneOf<LoadedScene, MaskedScene>;

namespace detail {

[[nodiscard]] inline std::vector<std::uint32_t> concatenated(const std::array<PrimitiveAttributes, 4>& attributes,
                                                             std::vector<std::uint32_t> PrimitiveAttributes::*member) {
  std::vector<std::uint32_t> result;
  for (const PrimitiveAttributes& kind : attributes) {
    result.insert(result.end(), (kind.*member).begin(), (kind.*member).end());
  }
  return result;
}

/// The tree over a set that the file's settings ask for.
template <typename Set, Executor E>
[[nodiscard]] Bvh<Set> bvh_over(Set set, const SceneFile& file, const E& executor) {
  constexpr std::size_t block_size = Bvh<Set>::Leaves::block_size;
  const auto by = [&](const auto& builder) { return Bvh<Set>{std::move(set), builder, executor}; };
  switch (file.accelerator.builder) {
    case BuilderKind::Median:
      return by(Median{});
    case BuilderKind::Morton:
      return by(Morton{.block_size = block_size});
    case BuilderKind::SweepSah:
      return by(SweepSah{.block_size = block_size});
    case BuilderKind::SpatialSah:
      return by(SpatialSah{.block_size = block_size});
    case BuilderKind::Best:
      return by(QualityBuilder{.quality = Quality::Best, .block_size = block_size});
    case BuilderKind::BinnedSah:
      break;
  }
  return by(Bvh<Set>::default_builder);
}

[[nodiscard]] inline MaterialTable<SceneMaterial> material_table_of(const SceneFile& file) {
  return {file.materials, concatenated(file.attributes, &PrimitiveAttributes::materials)};
}

[[nodiscard]] inline Lights<SceneLight> lights_of(const SceneFile& file) {
  return {file.lights, concatenated(file.attributes, &PrimitiveAttributes::lights)};
}

}  // namespace detail

/// The tree over the file's shapes that its settings ask for; opacity is not in it.
template <Executor E = Serial>
[[nodiscard]] SceneBvh bvh_of(const SceneFile& file, const E& executor = {}) {
  return detail::bvh_over(file.shapes(), file, executor);
}

/// The number of samples that the file asks for, and footprints where its textures do.
[[nodiscard]] inline RenderOptions options_of(const SceneFile& file) {
  return {.samples = file.integrator.samples, .footprint = file.filters_textures ? 1.0F : 0.0F};
}

/// The scene, ready for rendering. It views the file's buffers: the file has to outlive it and stay as it is.
///
/// Requires: everything is opaque; else see any_scene_of.
template <Executor E = Serial>
[[nodiscard]] LoadedScene scene_of(const SceneFile& file, const E& executor = {}) {
  GLINT_ASSERT(file.opacity_of_primitive.empty());
  return LoadedScene(bvh_of(file, executor), detail::material_table_of(file), detail::lights_of(file));
}

/// The scene of any file, of the type that it takes: `any_scene_of(file).visit([](const auto& scene) { … })`.
template <Executor E = Serial>
[[nodiscard]] AnyLoadedScene any_scene_of(const SceneFile& file, const E& executor = {}) {
  if (file.opacity_of_primitive.empty()) return scene_of(file, executor);
  const SceneShapes shapes = file.shapes();
  const Opacity opacity{shapes, std::span(file.opacities), std::span(file.opacity_of_primitive)};
  return MaskedScene(detail::bvh_over(Filtered{shapes, opacity}, file, executor), detail::material_table_of(file),
                     detail::lights_of(file));
}

}  // namespace glint

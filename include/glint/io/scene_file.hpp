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

#include <glint/bsdf/coated_diffuse.hpp>
#include <glint/bsdf/compensated.hpp>
#include <glint/bsdf/conductor.hpp>
#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bsdf/oren_nayar.hpp>
#include <glint/bsdf/perfect_refraction.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/bsdf/rough_dielectric.hpp>
#include <glint/bsdf/thin_dielectric.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/morton.hpp>
#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/core/executor.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/disk.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/io/scene_settings.hpp>
#include <glint/light/area.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/lights.hpp>
#include <glint/light/point.hpp>
#include <glint/light/spot.hpp>
#include <glint/light/triangle_sampler.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/textured.hpp>
#include <glint/material/two_sided.hpp>
#include <glint/scene/scene.hpp>
#include <glint/texture/any_texture.hpp>
#include <glint/texture/checkerboard.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/image_texture.hpp>

namespace glint {

/// What the materials, textures and lights of a scene file can be.
using SceneTexture = OneOf<ConstantTexture, Checkerboard, ImageTexture, AnyTexture>;
using SceneDiffuse = Textured<Lambertian, SceneTexture>;
using SceneRoughDiffuse = Textured<OrenNayar, SceneTexture>;
using ScenePlastic = Textured<CoatedDiffuse, SceneTexture>;
using SceneConductor = Textured<Conductor, SceneTexture>;
template <MicrofacetDistribution D>
using SceneRoughConductor = Textured<RoughConductor<D>, SceneTexture>;
template <MicrofacetDistribution D>
using SceneCompensatedConductor = Textured<Compensated<RoughConductor<D>>, SceneTexture>;
/// The most common ones first: which it is, is asked in this order.
using SceneMaterial =
    OneOf<SceneDiffuse, TwoSidedMaterial<SceneDiffuse>, PerfectRefraction, Dielectric, Mirror,
          SceneRoughConductor<Beckmann>, SceneRoughConductor<Ggx>, SceneCompensatedConductor<Beckmann>,
          SceneCompensatedConductor<Ggx>, SceneConductor, ScenePlastic, SceneRoughDiffuse,
          TwoSidedMaterial<SceneRoughDiffuse>, ThinDielectric, RoughDielectric<Beckmann>, RoughDielectric<Ggx>>;
using SceneLight = OneOf<PointLight, SpotLight, DirectionalLight, AreaLight<TriangleSampler>, AreaLight<Sphere<float>>,
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

namespace detail {

[[nodiscard]] inline std::vector<std::uint32_t> concatenated(const std::array<PrimitiveAttributes, 4>& attributes,
                                                             std::vector<std::uint32_t> PrimitiveAttributes::*member) {
  std::vector<std::uint32_t> result;
  for (const PrimitiveAttributes& kind : attributes) {
    result.insert(result.end(), (kind.*member).begin(), (kind.*member).end());
  }
  return result;
}

}  // namespace detail

/// The tree that the file's settings ask for.
template <Executor E = Serial>
[[nodiscard]] SceneBvh bvh_of(const SceneFile& file, const E& executor = {}) {
  constexpr std::size_t block_size = SceneBvh::Leaves::block_size;
  const auto by = [&](const auto& builder) { return SceneBvh{file.shapes(), builder, executor}; };
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
  return by(SceneBvh::default_builder);
}

/// The scene, ready for rendering. It views the file's buffers: the file has to outlive it and stay as it is.
template <Executor E = Serial>
[[nodiscard]] LoadedScene scene_of(const SceneFile& file, const E& executor = {}) {
  return LoadedScene(bvh_of(file, executor),
                     {file.materials, detail::concatenated(file.attributes, &PrimitiveAttributes::materials)},
                     {file.lights, detail::concatenated(file.attributes, &PrimitiveAttributes::lights)});
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/build/spatial_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/quantized.hpp>
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>

#include <peers/embree.hpp>
#include <peers/embree_packets.hpp>
#include <support/ray_sets.hpp>

/// Who takes part: the lists to extend.
namespace glint::bench {

/// Whether rays may slip between triangles that share an edge.
enum class Edges { Watertight, Fast };

/// How rays are handed over.
enum class Call { Single, Batch };

/// A tree of ours: the setting of Embree that is its like, and how it is made.
template <typename Make>
struct Ours {
  std::string name;
  Edges edges;
  std::string like;
  Call call;
  Make make;  ///< (const MeshBuffers<float>&, const Executor&) -> RayCaster
};
template <typename Make>
Ours(const char*, Edges, const char*, Call, Make) -> Ours<Make>;

template <typename Set, typename Executor>
[[nodiscard]] auto with_spatial_splits(const Set& set, const Executor& executor) {
  return Bvh(set, SpatialSah{.block_size = Bvh<Set>::Leaves::block_size}, executor);
}

/// Our trees, measured with rays.
[[nodiscard]] inline auto our_layouts() {
  return std::tuple{
      Ours{"wide8", Edges::Watertight, "medium", Call::Single,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Balanced, executor); }},
      Ours{"wide8-best", Edges::Watertight, "high", Call::Single,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Best, executor); }},
      Ours{"wide8-best-fast", Edges::Fast, "high", Call::Single,
           [](const auto& mesh, const auto& executor) {
             return build(view<MoellerTrumbore>(mesh), Quality::Best, executor);
           }},
      Ours{"wide8-spatial", Edges::Watertight, "high", Call::Single,
           [](const auto& mesh, const auto& executor) { return with_spatial_splits(view(mesh), executor); }},
      Ours{"wide8-spatial-fast", Edges::Fast, "high", Call::Single,
           [](const auto& mesh, const auto& executor) {
             return with_spatial_splits(view<MoellerTrumbore>(mesh), executor);
           }},
      Ours{"wide8-indexed", Edges::Watertight, "medium", Call::Single,
           [](const auto& mesh, const auto& executor) {
             return build(view(mesh), Quality::Balanced, executor, wide<8, IndexedBlocks<4>>);
           }},
      Ours{"quantized8", Edges::Watertight, "medium", Call::Single,
           [](const auto& mesh, const auto& executor) {
             return build(view(mesh), Quality::Balanced, executor, quantized<8>);
           }},
      Ours{"wide8-stream", Edges::Watertight, "medium", Call::Batch,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Balanced, executor); }},
  };
}

/// Our trees, measured by how long they take to be made.
[[nodiscard]] inline auto our_builds() {
  return std::tuple{
      Ours{"fast", Edges::Watertight, "medium", Call::Single,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Fast, executor); }},
      Ours{"balanced", Edges::Watertight, "medium", Call::Single,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Balanced, executor); }},
      Ours{"best", Edges::Watertight, "high", Call::Single,
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Best, executor); }},
      Ours{"spatial", Edges::Watertight, "high", Call::Single,
           [](const auto& mesh, const auto& executor) { return with_spatial_splits(view(mesh), executor); }},
  };
}

struct Theirs {
  std::string name;
  Edges edges;
  EmbreeSettings settings;
  Call call = Call::Single;
  RTCIntersectContextFlags rays = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;  ///< what packets are told of their rays
};

[[nodiscard]] inline std::vector<Theirs> their_settings() {
  constexpr EmbreeSettings medium{RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE};
  constexpr EmbreeSettings high{RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE};
  constexpr EmbreeSettings medium_robust{RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST};
  constexpr EmbreeSettings high_robust{RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_ROBUST};
  constexpr RTCIntersectContextFlags any = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  constexpr RTCIntersectContextFlags alike = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return {{"medium", Edges::Fast, medium},
          {"high", Edges::Fast, high},
          {"medium-robust", Edges::Watertight, medium_robust},
          {"high-robust", Edges::Watertight, high_robust},
          {"medium-packet8", Edges::Fast, medium, Call::Batch, any},
          {"medium-packet8-coherent", Edges::Fast, medium, Call::Batch, alike},
          {"medium-robust-packet8", Edges::Watertight, medium_robust, Call::Batch, any},
          {"medium-robust-packet8-coherent", Edges::Watertight, medium_robust, Call::Batch, alike}};
}

[[nodiscard]] inline EmbreeSettings settings_named(const std::string& name) {
  for (const Theirs& theirs : their_settings()) {
    if (theirs.name == name) return theirs.settings;
  }
  throw std::invalid_argument("no setting is named " + name);
}

using MaybeHit = std::optional<Hit<float>>;

/// A ray caster without its type. Rays are answered many at a time, so that this costs nothing.
struct Contender {
  std::string name;
  Edges edges = Edges::Watertight;
  std::string like;  ///< empty: one of Embree's
  Call call = Call::Single;
  std::size_t bytes = 0;
  std::function<void(std::span<const Ray<float>>, std::span<MaybeHit>)> closest;
  std::function<void(std::span<const Ray<float>>, std::span<bool>)> occluded;
  std::function<MaybeHit(const Ray<float>&)> witness;  ///< what it means where it says that something is in the way
};

/// What is answered ray by ray.
template <typename Caster>
[[nodiscard]] Contender singly(const std::shared_ptr<const Caster>& caster) {
  Contender result;
  result.bytes = caster->bytes();
  result.closest = [caster](std::span<const Ray<float>> rays, std::span<MaybeHit> hits) {
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = caster->closest(rays[i]);
  };
  result.occluded = [caster](std::span<const Ray<float>> rays, std::span<bool> results) {
    for (std::size_t i = 0; i < rays.size(); ++i) results[i] = caster->occluded(rays[i]);
  };
  result.witness = [caster](const Ray<float>& ray) { return caster->closest(ray); };
  return result;
}

/// What is answered many rays at a time.
template <typename Caster>
[[nodiscard]] Contender in_batches(const std::shared_ptr<const Caster>& caster) {
  Contender result;
  result.call = Call::Batch;
  result.bytes = caster->bytes();
  result.closest = [caster](std::span<const Ray<float>> rays, std::span<MaybeHit> hits) {
    caster->closest(rays, hits);
  };
  result.occluded = [caster](std::span<const Ray<float>> rays, std::span<bool> results) {
    caster->occluded(rays, results);
  };
  result.witness = [caster](const Ray<float>& ray) { return caster->closest(ray); };
  return result;
}

template <typename Make, typename Executor>
[[nodiscard]] Contender contender(const Ours<Make>& ours, const MeshBuffers<float>& mesh, const Executor& executor) {
  using Caster = decltype(ours.make(mesh, executor));
  const auto caster = std::make_shared<const Caster>(ours.make(mesh, executor));
  Contender result = ours.call == Call::Single ? singly(caster) : in_batches(caster);
  result.name = ours.name;
  result.edges = ours.edges;
  result.like = ours.like;
  return result;
}

[[nodiscard]] inline Contender contender(const Theirs& theirs, const MeshBuffers<float>& mesh,
                                         const EmbreeDevice& device) {
  const auto caster = std::make_shared<const EmbreeCaster>(device, mesh, theirs.settings);
  Contender result = theirs.call == Call::Single
                         ? singly(caster)
                         : in_batches(std::make_shared<const EmbreePackets>(caster, theirs.rays));
  result.name = theirs.name;
  result.edges = theirs.edges;
  return result;
}

}  // namespace glint::bench

// SPDX-License-Identifier: MIT
#pragma once
#include <cstddef>
#include <cstdint>
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
#include <glint/bvh/layout/triangle_blocks.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/ray_triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/constants.hpp>

#include <peers/embree.hpp>
#include <peers/ray_sets.hpp>

/// Who takes part: the lists to extend.
namespace glint::bench {

/// Whether rays may slip between triangles that share an edge.
enum class Edges { Watertight, Fast };

/// A tree of ours: the setting of Embree that is its like, and how it is made.
template <typename Make>
struct Ours {
  std::string name;
  Edges edges;
  std::string like;
  Make make;  ///< (const MeshBuffers<float>&, const Executor&) -> RayCaster
};
template <typename Make>
Ours(const char*, Edges, const char*, Make) -> Ours<Make>;

/// Our trees, measured with rays.
[[nodiscard]] inline auto our_layouts() {
  return std::tuple{
      Ours{"wide8", Edges::Watertight, "medium",
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Balanced, executor); }},
      Ours{"wide8-best", Edges::Watertight, "high",
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Best, executor); }},
      Ours{"wide8-best-fast", Edges::Fast, "high",
           [](const auto& mesh, const auto& executor) {
             return build(view<MoellerTrumbore>(mesh), Quality::Best, executor);
           }},
      Ours{"wide8-indexed", Edges::Watertight, "medium",
           [](const auto& mesh, const auto& executor) {
             return build(view(mesh), Quality::Balanced, executor, wide<8, IndexedBlocks<4>>);
           }},
  };
}

/// Our trees, measured by how long they take to be made.
[[nodiscard]] inline auto our_builds() {
  return std::tuple{
      Ours{"fast", Edges::Watertight, "medium",
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Fast, executor); }},
      Ours{"balanced", Edges::Watertight, "medium",
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Balanced, executor); }},
      Ours{"best", Edges::Watertight, "high",
           [](const auto& mesh, const auto& executor) { return build(view(mesh), Quality::Best, executor); }},
  };
}

struct Theirs {
  std::string name;
  Edges edges;
  EmbreeSettings settings;
};

[[nodiscard]] inline std::vector<Theirs> their_settings() {
  return {{"medium", Edges::Fast, {RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_NONE}},
          {"high", Edges::Fast, {RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_NONE}},
          {"medium-robust", Edges::Watertight, {RTC_BUILD_QUALITY_MEDIUM, RTC_SCENE_FLAG_ROBUST}},
          {"high-robust", Edges::Watertight, {RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_ROBUST}}};
}

[[nodiscard]] inline EmbreeSettings settings_named(const std::string& name) {
  for (const Theirs& theirs : their_settings()) {
    if (theirs.name == name) return theirs.settings;
  }
  throw std::invalid_argument("no setting is named " + name);
}

/// A ray caster without its type. Rays are answered many at a time, so that this costs nothing.
struct Contender {
  std::string name;
  Edges edges = Edges::Watertight;
  std::string like;  ///< empty: one of Embree's
  std::size_t bytes = 0;
  std::function<void(Question, std::span<const Ray<float>>, std::span<Hit<float>>)> answer;
  std::function<std::optional<Hit<float>>(const Ray<float>&)> witness;
};

template <typename Caster>
void answer_one_by_one(const Caster& caster, Question question, std::span<const Ray<float>> rays,
                       std::span<Hit<float>> answers) {
  constexpr Hit<float> missed{.t = infinity<float>};
  if (question == Question::Closest) {
    for (std::size_t i = 0; i < rays.size(); ++i) answers[i] = caster.closest(rays[i]).value_or(missed);
  } else {
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers[i].primitive = caster.occluded(rays[i]) ? 0 : missed.primitive;
  }
}

template <typename Caster>
[[nodiscard]] Contender contender(std::string name, Edges edges, std::string like,
                                  const std::shared_ptr<const Caster>& caster) {
  return {.name = std::move(name),
          .edges = edges,
          .like = std::move(like),
          .bytes = caster->bytes(),
          .answer = [caster](Question question, std::span<const Ray<float>> rays,
                             std::span<Hit<float>> answers) { answer_one_by_one(*caster, question, rays, answers); },
          .witness = [caster](const Ray<float>& ray) { return caster->closest(ray); }};
}

}  // namespace glint::bench

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bvh/brute_force.hpp>
#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/build/median.hpp>
#include <glint/bvh/build/sweep_sah.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/layout/binary.hpp>
#include <glint/bvh/layout/wide.hpp>
#include <glint/geometry/offset.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_rays.hpp>
#include <glint/testing/ray_caster_laws.hpp>

#include <support/bench.hpp>

namespace {

using namespace glint;
using Mesh = decltype(view(std::declval<const MeshBuffers<float>&>()));
using Rays = std::vector<Ray<float>>;

/// Rays as a path tracer casts them: from a camera, on from what they hit in a random direction, and to a light.
struct RaySets {
  Rays primary;
  Rays diffuse;
  Rays shadow;
};

[[nodiscard]] RaySets cast_from_camera(const Bvh<Mesh>& bvh, int pixels) {
  RaySets sets;
  Random random(7);
  const Aabb<float> box = bvh.bounds();
  const float size = glm::length(extent(box));
  const Vec3<float> eye = centroid(box) + Vec3<float>{0.3F, 0.4F, 1.0F} * size;
  const Vec3<float> light = centroid(box) + Vec3<float>{0.5F, 2.0F, 1.0F} * size;
  const Vec3<float> forward = glm::normalize(centroid(box) - eye);
  const Vec3<float> right = glm::normalize(glm::cross(forward, Vec3<float>{0, 1, 0}));
  const Vec3<float> up = glm::cross(right, forward);
  for (int y = 0; y < pixels; ++y) {
    for (int x = 0; x < pixels; ++x) {
      const float u = 0.35F * (2 * (float(x) + random.uniform<float>()) / float(pixels) - 1);
      const float v = 0.35F * (1 - 2 * (float(y) + random.uniform<float>()) / float(pixels));
      const Ray<float> ray{.origin = eye, .direction = glm::normalize(forward + right * u + up * v)};
      sets.primary.push_back(ray);
      const auto hit = bvh.closest(ray);
      if (!hit) continue;
      SurfaceOf<float> at = bvh.surface(ray, *hit);
      if (glm::dot(at.normal, ray.direction) > 0) at.normal = -at.normal;
      const Vec3<float> bounce = at.normal * 1.001F + testing::detail::random_unit_vector<float>(random);
      sets.diffuse.push_back(spawn_ray(at, glm::normalize(bounce)));
      sets.shadow.push_back(spawn_ray_to(at, light));
    }
  }
  return sets;
}

/// A mesh, rays at it, and what the rays hit, by a tree and layout that are not measured.
struct Scene {
  std::string name;
  MeshBuffers<float> buffers;
  RaySets rays;
};

template <typename B>
void report(benchmark::State& state, const B& bvh, std::size_t rays) {
  state.counters["Mrays/s"] = benchmark::Counter(double(rays) * 1e-6, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["bytes/triangle"] = double(bvh.bytes()) / double(std::max<std::size_t>(1, bvh.set().size()));
}

/// Every `step`-th ray is checked against brute force, so that about 10⁷ triangles are tried.
template <typename B>
[[nodiscard]] bool agrees_with_brute_force(const B& bvh, const Rays& rays) {
  const BruteForce oracle(bvh.set());
  const std::size_t checked = std::clamp<std::size_t>(10'000'000 / (bvh.set().size() + 1), 2, 100);
  const std::size_t step = std::max<std::size_t>(1, rays.size() / checked);
  for (std::size_t i = 0; i < rays.size(); i += step) {
    const auto expected = oracle.closest(rays[i]);
    if (!testing::agree(rays[i], bvh.closest(rays[i]), expected)) return false;
    if (bvh.occluded(rays[i]) != expected.has_value()) return false;
  }
  return true;
}

/// And all of them against another tree in another layout.
template <typename B>
[[nodiscard]] bool agrees_with_another(const B& bvh, const Rays& rays) {
  const Bvh other(bvh.set(), Median{}, binary);
  return std::all_of(rays.begin(), rays.end(), [&](const Ray<float>& ray) {
    const auto expected = other.closest(ray);
    return testing::agree(ray, bvh.closest(ray), expected) && bvh.occluded(ray) == expected.has_value();
  });
}

template <typename B>
void closest(benchmark::State& state, const B& bvh, const Rays& rays) {
  for (auto _ : state) {
    std::size_t hits = 0;
    for (const Ray<float>& ray : rays) hits += bvh.closest(ray).has_value();
    benchmark::DoNotOptimize(hits);
  }
  report(state, bvh, rays.size());
}

template <typename B>
void occluded(benchmark::State& state, const B& bvh, const Rays& rays) {
  for (auto _ : state) {
    std::size_t hits = 0;
    for (const Ray<float>& ray : rays) hits += bvh.occluded(ray);
    benchmark::DoNotOptimize(hits);
  }
  report(state, bvh, rays.size());
}

/// The tree is built when its first benchmark runs, and let go after its last.
template <typename LayoutName, typename Builder>
void register_bvh(const std::string& name, const Scene& scene, const Builder& builder, LayoutName layout) {
  const auto built = std::make_shared<std::unique_ptr<Bvh<Mesh, LayoutName>>>();
  const auto add = [&](const std::string& kind, const Rays& rays, auto measure, bool last) {
    benchmark::RegisterBenchmark((name + '/' + scene.name + '/' + kind).c_str(), [=, &scene, &rays](auto& state) {
      if (!*built) *built = std::make_unique<Bvh<Mesh, LayoutName>>(view(scene.buffers), builder, layout);
      measure(state, **built, rays);
      const bool right = agrees_with_brute_force(**built, rays) && agrees_with_another(**built, rays);
      if (bench::verify(state, right, "a ray found something else than brute force or another tree did") && !last)
        return;
      built->reset();
    })->Unit(benchmark::kMillisecond);
  };
  using B = Bvh<Mesh, LayoutName>;
  add("primary", scene.rays.primary, closest<B>, false);
  add("diffuse", scene.rays.diffuse, closest<B>, false);
  add("shadow", scene.rays.shadow, occluded<B>, true);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<Scene> scenes;
  return bench::run(argc, argv, [&](const bench::Options& options) {
    for (bench::NamedMesh& mesh : bench::meshes(options)) scenes.push_back({mesh.name, std::move(mesh.buffers), {}});
    for (Scene& scene : scenes) {
      scene.rays = cast_from_camera(Bvh(view(scene.buffers)), options.quick ? 60 : 512);
      register_bvh("binned sah, wide 8", scene, BinnedSah{}, wide<8>);
      register_bvh("binned sah, wide 4", scene, BinnedSah{}, wide<4>);
      register_bvh("binned sah, binary", scene, BinnedSah{}, binary);
      register_bvh("sweep sah, wide 8", scene, SweepSah{}, wide<8>);
      register_bvh("median, wide 8", scene, Median{}, wide<8>);
    }
  });
}

// SPDX-License-Identifier: MIT
// What is asked of a tree beside rays from a camera, in turns with Embree: closest points, pairs that overlap, rays
// into instances, and following vertices that move. Every answer is checked.
#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iterator>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/bvh/query/pairs.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

#include <peers/contenders.hpp>
#include <peers/distances.hpp>
#include <peers/embree.hpp>
#include <peers/embree_queries.hpp>
#include <peers/instances.hpp>
#include <peers/judge.hpp>
#include <peers/mesh_list.hpp>
#include <peers/options.hpp>
#include <peers/race.hpp>
#include <peers/report.hpp>
#include <peers/turns.hpp>
#include <support/named_mesh.hpp>
#include <support/ray_sets.hpp>

namespace {

using namespace glint;
using namespace glint::bench;

/// The same mesh, turned about its center and moved aside a little.
[[nodiscard]] MeshBuffers<float> turned(const MeshBuffers<float>& mesh, const Aabb<float>& box) {
  MeshBuffers<float> result = mesh;
  const Vec3<float> center = centroid(box);
  const auto about_center = Affine<float>::translate(center + 0.1F * extent(box)) *
                            Affine<float>::rotate({1, 1, 0}, 0.5F) * Affine<float>::translate(-center);
  for (Vec3<float>& p : result.positions) p = about_center.point(p);
  return result;
}

struct Queries {
  PeerOptions options;
  std::vector<std::string> measures{"near", "far", "radius", "pairs", "instances", "refit"};
  std::size_t wrong = 0;

  [[nodiscard]] bool is_asked(const std::string& measure) const { return is_wanted(options, measures, measure); }

  void measure(const NamedMesh& mesh) {
    std::printf("\n%s: %zu triangles\n", mesh.name.c_str(), mesh.buffers.indices.size() / 3);
    const EmbreeDevice device(1);
    std::size_t answers = 0;
    if (is_asked("near") || is_asked("far") || is_asked("radius")) answers += measure_points(mesh, device);
    if (is_asked("pairs")) answers += measure_pairs(mesh, device);
    if (is_asked("instances")) answers += measure_instances(mesh, device);
    if (is_asked("refit")) answers += measure_refit(mesh, device);
    std::printf("WRONG %s %zu\n", mesh.name.c_str(), answers);
    wrong += answers;
  }

  [[nodiscard]] std::size_t measure_points(const NamedMesh& mesh, const EmbreeDevice& device) const {
    const auto ours = build(view(mesh.buffers));
    const EmbreeCaster theirs(device, mesh.buffers);
    const DistanceJudge judge(mesh.buffers);
    const float size = glm::length(extent(ours.bounds()));
    const std::size_t count = std::size_t(1) << (options.quick ? 8 : 15);
    std::size_t answers = 0;
    const auto measure = [&](const char* what, const Points& points, float radius) {
      if (!is_asked(what)) return;
      const Turns turns = race_points(ours, theirs, judge, points, radius, answers);
      turns.print(mesh.name, what, "balanced", "medium");
    };
    measure("near", points_near(ours.set(), 0.01F * size, count), infinity<float>);
    measure("far", points_about(ours.bounds(), 2, count), infinity<float>);
    measure("radius", points_about(ours.bounds(), 1, count), 0.02F * size);
    return answers;
  }

  [[nodiscard]] Turns race_points(const Bvh<TriangleMesh<float>>& ours, const EmbreeCaster& theirs,
                                  const DistanceJudge& judge, const Points& points, float radius,
                                  std::size_t& wrong_answers) const {
    using Answers = std::vector<ClosestPoint<float>>;
    Answers our_answers(points.size());
    Answers their_answers(points.size());
    const auto each = [&](Answers& answers, const auto& ask) {
      return [&](std::size_t first, std::size_t count) {
        for (std::size_t i = first; i < first + count; ++i) answers[i] = ask(points[i]);
      };
    };
    const auto ask_ours = [&](const Vec3<float>& point) {
      return closest_point(ours, point, radius).value_or(ClosestPoint<float>{});
    };
    const auto ask_theirs = [&](const Vec3<float>& point) {
      return closest_point_in(theirs, ours.set(), point, radius);
    };
    Turns turns(options.quick);
    turns.run(points.size(), 1 << 10, each(our_answers, ask_ours), each(their_answers, ask_theirs));
    for (std::size_t i = 0; i < points.size(); ++i) {
      const bool is_right = judge.is_right(points[i], our_answers[i], their_answers[i], radius) &&
                            (i >= 16 || judge.is_least(points[i], our_answers[i], radius));
      wrong_answers += is_right ? 0U : 1U;
    }
    return turns;
  }

  [[nodiscard]] std::size_t measure_pairs(const NamedMesh& mesh, const EmbreeDevice& device) const {
    const auto ours = build(view(mesh.buffers));
    const MeshBuffers<float> other = turned(mesh.buffers, ours.bounds());
    const auto our_other = build(view(other));
    const EmbreeBoxes theirs(device, ours.set());
    const EmbreeBoxes their_other(device, our_other.set());
    IndexPairs our_pairs;
    IndexPairs their_pairs;
    Turns turns(options.quick);
    turns.run(
        1, 1,
        [&](std::size_t, std::size_t) {
          our_pairs.clear();
          for_each_overlapping_pair(ours, our_other, [&](auto i, auto j) { our_pairs.emplace_back(i, j); });
        },
        [&](std::size_t, std::size_t) { collide(theirs, their_other, their_pairs); });
    turns.print(mesh.name, "pairs", "balanced", "medium");
    std::sort(our_pairs.begin(), our_pairs.end());
    std::sort(their_pairs.begin(), their_pairs.end());
    IndexPairs differing;
    std::set_symmetric_difference(our_pairs.begin(), our_pairs.end(), their_pairs.begin(), their_pairs.end(),
                                  std::back_inserter(differing));
    return differing.size() + (overlapping_pairs(ours, our_other) == our_pairs ? 0U : 1U);
  }

  [[nodiscard]] std::size_t measure_instances(const NamedMesh& mesh, const EmbreeDevice& device) const {
    const Aabb<float> box = Bvh(view(mesh.buffers)).bounds();
    const Places stand = places(box, options.quick ? 3 : 10);
    const Contenders all = instance_contenders(device, mesh.buffers, stand);
    const Aabb<float> bounds = OurInstances(mesh.buffers, stand, Quality::Balanced).bounds();
    const InstancesJudge judge(mesh.buffers, stand, glm::length(extent(bounds)));
    std::vector<std::size_t> answers(all.size());
    std::vector<Measured> measured;
    for (RaySet& set : instance_ray_sets(bounds, std::size_t(1) << (options.quick ? 10 : 15))) {
      measured.push_back(run(all, std::move(set), options.quick));
      count_wrong(all, measured.back(), judge, answers);
    }
    print_rates(mesh.name, all, measured);
    for (const Measured& one : measured) {
      print_best(mesh.name, all, one, Call::Single, Edges::Watertight);
      print_best(mesh.name, all, one, Call::Single, Edges::Fast);
    }
    std::size_t of_ours = 0;
    for (std::size_t i = 0; i < all.size(); ++i) of_ours += is_ours(all[i]) ? answers[i] : 0U;
    return of_ours;
  }

  /// Vertices sway by a few thousandths of the mesh's size; in time is what it takes until rays may be cast.
  [[nodiscard]] std::size_t measure_refit(const NamedMesh& mesh, const EmbreeDevice& device) const {
    MeshBuffers<float> moving = mesh.buffers;
    auto ours = build(view(moving));
    const EmbreeCaster theirs(device, moving, embree_refits);
    const float size = glm::length(extent(ours.bounds()));
    float phase = 0;
    const auto sway = [&] {
      phase += 0.5F;
      for (std::size_t i = 0; i < moving.positions.size(); ++i) {
        const Vec3<float>& at_rest = mesh.buffers.positions[i];
        const Vec3<float> across{at_rest.y, at_rest.z, at_rest.x};
        moving.positions[i] = at_rest + glm::sin(across * (20 / size) + phase) * (0.003F * size);
      }
    };
    Turns turns(options.quick);
    turns.run_after(
        sway, [&] { static_cast<void>(ours.refit()); }, [&] { theirs.commit_moved(); });
    device.throw_errors();
    turns.print(mesh.name, "refit", "balanced", "refit");
    const Judge judge(moving);
    std::size_t answers = 0;
    each_camera_ray(mesh.viewpoint.value_or(look_at_all(ours.bounds())), 64, [&](const Ray<float>& ray) {
      const MaybeHit hit = ours.closest(ray);
      if (!same(hit, theirs.closest(ray)) && !judge.is_right(ray, hit)) ++answers;
    });
    return answers;
  }
};

}  // namespace

int main(int argc, char** argv) try {
  std::setvbuf(stdout, nullptr, _IOLBF, BUFSIZ);  // lines as they come, also into files
  Queries queries{parse_peer_options({argv + 1, argv + argc}, queries_help)};
  if (queries.options.help) {
    std::fputs(queries_help.data(), stdout);
    return EXIT_SUCCESS;
  }
  check_names(queries.options, {mesh_names(queries.options), queries.measures});
  for_each_mesh(queries.options, [&](const NamedMesh& mesh) { queries.measure(mesh); });
  return queries.wrong == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
} catch (const std::exception& error) {
  std::fprintf(stderr, "bench_queries: %s\n", error.what());
  return EXIT_FAILURE;
}

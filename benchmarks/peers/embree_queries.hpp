// SPDX-License-Identifier: MIT
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <glint/bvh/query/nearest.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/geometry/triangle_triangle.hpp>
#include <glint/math/vec.hpp>

#include <peers/embree.hpp>

/// What Embree answers beside rays. It finds candidates; what is asked of a triangle is up to the caller, and done here
/// as one who wants speed does it.
namespace glint::bench {

/// The way that is taken with Embree: by the region of the plane that the point is over, at one division at most.
///
/// Source: Ericson, Real-Time Collision Detection (2005), section 5.1.5.
[[nodiscard]] inline Vec3<float> closest_by_regions(const Vec3<float>& p, const Triangle<float>& triangle) noexcept {
  const auto& [a, b, c] = triangle;
  const Vec3<float> ab = b - a;
  const Vec3<float> ac = c - a;
  const float d1 = glm::dot(ab, p - a);
  const float d2 = glm::dot(ac, p - a);
  if (d1 <= 0 && d2 <= 0) return a;
  const float d3 = glm::dot(ab, p - b);
  const float d4 = glm::dot(ac, p - b);
  if (d3 >= 0 && d4 <= d3) return b;
  const float d5 = glm::dot(ab, p - c);
  const float d6 = glm::dot(ac, p - c);
  if (d6 >= 0 && d5 <= d6) return c;
  const float of_c = d1 * d4 - d3 * d2;
  if (of_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
  const float of_b = d5 * d2 - d1 * d6;
  if (of_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
  const float of_a = d3 * d6 - d5 * d4;
  if (of_a <= 0 && d4 >= d3 && d5 >= d6) return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
  const float scale = 1 / (of_a + of_b + of_c);
  return a + ab * (of_b * scale) + ac * (of_c * scale);
}

/// The closest point of a mesh by rtcPointQuery: the radius shrinks to what was found. `primitive` is none where
/// nothing is within `radius`.
[[nodiscard]] inline ClosestPoint<float> closest_point_in(const EmbreeCaster& caster, const TriangleMesh<float>& mesh,
                                                          const Vec3<float>& point, float radius) noexcept {
  struct Search {
    const TriangleMesh<float>& mesh;
    Vec3<float> point;
    ClosestPoint<float> best;
  };
  Search search{mesh, point, {.distance = radius}};
  const auto visit = [](RTCPointQueryFunctionArguments* at) {
    Search& so_far = *static_cast<Search*>(at->userPtr);
    const Vec3<float> position = closest_by_regions(so_far.point, so_far.mesh.triangle(at->primID));
    const float distance = glm::length(position - so_far.point);
    if (!(distance < at->query->radius)) return false;
    so_far.best = {position, distance, at->primID};
    at->query->radius = distance;
    return true;
  };
  RTCPointQuery query;
  query.x = point.x;
  query.y = point.y;
  query.z = point.z;
  query.time = 0;
  query.radius = radius;
  RTCPointQueryContext context;
  rtcInitPointQueryContext(&context);
  rtcPointQuery(caster.handle(), &query, &context, visit, &search);
  return search.best;
}

/// A committed scene whose primitives are boxes of triangles: the kind that rtcCollide takes.
class EmbreeBoxes {
 public:
  /// Requires: the mesh's buffers and this stay where they are.
  EmbreeBoxes(const EmbreeDevice& device, const TriangleMesh<float>& mesh)
      : mesh_(mesh), scene_(rtcNewScene(device.handle())) {
    const RTCGeometry geometry = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, unsigned(mesh_.size()));
    const auto box_of = [](const RTCBoundsFunctionArguments* asked) {
      const Aabb<float> box = static_cast<const EmbreeBoxes*>(asked->geometryUserPtr)->mesh_.bounds(asked->primID);
      *asked->bounds_o = {box.lower.x, box.lower.y, box.lower.z, 0, box.upper.x, box.upper.y, box.upper.z, 0};
    };
    rtcSetGeometryBoundsFunction(geometry, box_of, nullptr);
    rtcSetGeometryUserData(geometry, this);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    device.throw_errors();
  }
  EmbreeBoxes(const EmbreeBoxes&) = delete;
  EmbreeBoxes& operator=(const EmbreeBoxes&) = delete;
  EmbreeBoxes(EmbreeBoxes&&) = delete;
  EmbreeBoxes& operator=(EmbreeBoxes&&) = delete;
  ~EmbreeBoxes() = default;

  [[nodiscard]] const TriangleMesh<float>& mesh() const noexcept { return mesh_; }
  [[nodiscard]] RTCScene handle() const noexcept { return scene_.get(); }

 private:
  TriangleMesh<float> mesh_;
  EmbreeScene scene_;
};

using IndexPairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// The triangles of two meshes that overlap, by the test that ours takes: boxes first, then exactly. In no order.
inline void collide(const EmbreeBoxes& a, const EmbreeBoxes& b, IndexPairs& pairs) {
  struct Search {
    const TriangleMesh<float>& a;
    const TriangleMesh<float>& b;
    IndexPairs& pairs;
  };
  Search search{a.mesh(), b.mesh(), pairs};
  const auto visit = [](void* searched, RTCCollision* candidates, unsigned count) {
    Search& so_far = *static_cast<Search*>(searched);
    for (unsigned k = 0; k < count; ++k) {
      const std::uint32_t i = candidates[k].primID0;
      const std::uint32_t j = candidates[k].primID1;
      if (!overlaps(so_far.a.bounds(i), so_far.b.bounds(j))) continue;
      if (overlaps(so_far.a.triangle(i), so_far.b.triangle(j))) so_far.pairs.emplace_back(i, j);
    }
  };
  pairs.clear();
  rtcCollide(a.handle(), b.handle(), visit, &search);
}

}  // namespace glint::bench

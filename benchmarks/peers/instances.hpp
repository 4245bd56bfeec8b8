// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include <embree3/rtcore.h>
#include <glm/geometric.hpp>

#include <glint/bvh/build/quality.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/transform.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

#include <peers/contenders.hpp>
#include <peers/embree.hpp>
#include <peers/judge.hpp>
#include <peers/race.hpp>
#include <support/ray_sets.hpp>

/// A thousand instances of one mesh, ours and theirs.
namespace glint::bench {

using Places = std::vector<Affine<float>>;

/// A loose grid of `per_axis`³ places for a thing of this size, each turned and scaled in its own way.
[[nodiscard]] inline Places places(const Aabb<float>& box, int per_axis) {
  Random random(13);
  const float size = glm::length(extent(box));
  Places all;
  for (int i = 0; i < per_axis * per_axis * per_axis; ++i) {
    const Vec3<float> cell{float(i % per_axis), float(i / per_axis % per_axis), float(i / per_axis / per_axis)};
    const Vec3<float> spot = (cell + random.uniform_vec3<float>() * 0.5F) * size * 0.8F;
    const Vec3<float> axis = random.uniform_vec3<float>() + 0.1F;
    const float angle = 2 * pi<float> * random.uniform<float>();
    const Vec3<float> scale = random.uniform_vec3<float>() * 0.7F + 0.5F;
    all.push_back(Affine<float>::translate(spot) * Affine<float>::rotate(axis, angle) * Affine<float>::scale(scale) *
                  Affine<float>::translate(-centroid(box)));
  }
  return all;
}

/// Two levels of ours. Models RayCaster.
class OurInstances {
 public:
  OurInstances(const MeshBuffers<float>& mesh, const Places& places, Quality quality)
      : object_(std::make_unique<const Object>(build(view(mesh), quality))) {
    for (const Affine<float>& place : places) instances_.push_back(glint::place(*object_, place));
    world_ = std::make_unique<const Bvh<Instanced<Object>>>(build(Instanced{instances_}, quality));
  }

  [[nodiscard]] std::size_t bytes() const noexcept { return object_->bytes() + world_->bytes(); }
  [[nodiscard]] Aabb<float> bounds() const noexcept { return world_->bounds(); }
  [[nodiscard]] MaybeHit closest(const Ray<float>& ray) const { return world_->closest(ray); }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const { return world_->occluded(ray); }

 private:
  using Object = Bvh<TriangleMesh<float>>;
  std::unique_ptr<const Object> object_;
  std::vector<Instance<Object>> instances_;
  std::unique_ptr<const Bvh<Instanced<Object>>> world_;
};

/// Two levels of theirs. Models RayCaster; `primitive` is the instance, `inner` the triangle, as ours has it.
class EmbreeInstances {
 public:
  EmbreeInstances(const EmbreeDevice& device, const MeshBuffers<float>& mesh, const Places& places,
                  EmbreeSettings settings)
      : object_(device, mesh, settings), bytes_(-device.bytes()), scene_(rtcNewScene(device.handle())) {
    rtcSetSceneBuildQuality(scene_.get(), settings.quality);
    rtcSetSceneFlags(scene_.get(), settings.flags);
    for (const Affine<float>& place : places) {
      const RTCGeometry instance = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_INSTANCE);
      rtcSetGeometryInstancedScene(instance, object_.handle());
      const Mat3<float>& m = place.linear;
      const Vec3<float>& t = place.translation;
      const float columns[] = {m[0].x, m[0].y, m[0].z, m[1].x, m[1].y, m[1].z, m[2].x, m[2].y, m[2].z, t.x, t.y, t.z};
      rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
      rtcCommitGeometry(instance);
      rtcAttachGeometry(scene_.get(), instance);
      rtcReleaseGeometry(instance);
    }
    rtcCommitScene(scene_.get());
    device.throw_errors();
    bytes_ += device.bytes();
  }

  [[nodiscard]] std::size_t bytes() const noexcept { return object_.bytes() + std::size_t(bytes_); }
  [[nodiscard]] MaybeHit closest(const Ray<float>& ray) const noexcept {
    const RTCRayHit found = closest_in(scene_.get(), ray);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit<float>{found.ray.tfar, {found.hit.u, found.hit.v}, found.hit.instID[0], found.hit.primID};
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const noexcept { return occluded_in(scene_.get(), ray); }

 private:
  EmbreeCaster object_;
  std::ptrdiff_t bytes_;
  EmbreeScene scene_;
};

[[nodiscard]] inline Contenders instance_contenders(const EmbreeDevice& device, const MeshBuffers<float>& mesh,
                                                    const Places& places) {
  Contenders all;
  for (const Quality quality : {Quality::Balanced, Quality::Best}) {
    all.push_back(singly(std::make_shared<const OurInstances>(mesh, places, quality)));
    all.back().name = quality == Quality::Best ? "best" : "balanced";
    all.back().like = quality == Quality::Best ? "high" : "medium";
  }
  for (const Theirs& theirs : their_settings()) {
    if (theirs.call != Call::Single) continue;
    all.push_back(singly(std::make_shared<const EmbreeInstances>(device, mesh, places, theirs.settings)));
    all.back().name = theirs.name;
    all.back().edges = theirs.edges;
  }
  return all;
}

/// The judge of one mesh, asked in the space of each instance.
class InstancesJudge {
 public:
  InstancesJudge(const MeshBuffers<float>& mesh, const Places& places, float reach) : judge_(mesh, double(reach)) {
    for (const Affine<float>& place : places) to_local_.push_back(inverse(place).value());
  }

  /// Whether this may be the closest hit.
  [[nodiscard]] bool is_right(const Ray<float>& ray, const MaybeHit& hit) const {
    for (std::size_t i = 0; i < to_local_.size(); ++i) {
      Ray<float> local = transform(to_local_[i], ray);
      if (hit) local.t_max = std::min(local.t_max, hit->t);
      MaybeHit here;
      if (hit && hit->primitive == i) here = Hit<float>{.t = hit->t, .uv = hit->uv, .primitive = hit->inner};
      if (!judge_.is_right(local, here)) return false;
    }
    return true;
  }
  [[nodiscard]] bool is_right(const Ray<float>& ray, bool occluded, const MaybeHit& witness) const {
    return is_right(ray, occluded ? witness : std::nullopt);
  }

 private:
  Judge judge_;
  std::vector<Affine<float>> to_local_;
};

/// Rays through the scene as images have them, and from anywhere in it to anywhere.
[[nodiscard]] inline std::vector<RaySet> instance_ray_sets(const Aabb<float>& box, std::size_t count) {
  std::vector<RaySet> sets{{.name = "primary"}, {.name = "random"}};
  each_camera_ray(look_at_all(box), int(std::ceil(std::sqrt(double(count)))),
                  [&](const Ray<float>& ray) { sets[0].rays.push_back(ray); });
  Random random(17);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3<float> origin = box.lower + random.uniform_vec3<float>() * extent(box);
    const Vec3<float> target = box.lower + random.uniform_vec3<float>() * extent(box);
    sets[1].rays.push_back({.origin = origin, .direction = glm::normalize(target - origin)});
  }
  return sets;
}

}  // namespace glint::bench

// SPDX-License-Identifier: MIT
#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include <embree3/rtcore.h>
#include <sys/types.h>

#include <glint/geometry/aabb.hpp>
#include <glint/geometry/hit.hpp>
#include <glint/geometry/mesh_buffers.hpp>
#include <glint/geometry/ray.hpp>
#include <glint/math/vec.hpp>

/// Embree behind glint's concepts, so that the same loop measures both.
namespace glint::bench {

/// Embree's library state: its threads, and a count of the memory it holds. One at a time: devices share a thread pool,
/// which has the size that the most demanding of them asks for.
class EmbreeDevice {
 public:
  explicit EmbreeDevice(int threads)
      : device_(rtcNewDevice(("threads=" + std::to_string(threads) + ",user_threads=1").c_str())) {
    if (!device_)
      throw std::runtime_error("Embree gives no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
    const auto count = [](void* bytes, ssize_t change, bool /*after*/) {
      *static_cast<std::atomic<std::ptrdiff_t>*>(bytes) += change;
      return true;
    };
    rtcSetDeviceMemoryMonitorFunction(device_.get(), count, bytes_.get());
  }

  [[nodiscard]] RTCDevice handle() const noexcept { return device_.get(); }
  [[nodiscard]] std::ptrdiff_t bytes() const noexcept { return *bytes_; }

  /// Errors: what went wrong since it was last asked.
  void throw_errors() const {
    const RTCError error = rtcGetDeviceError(device_.get());
    if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree fails with error " + std::to_string(error));
  }

 private:
  struct Release {
    void operator()(RTCDevice device) const noexcept { rtcReleaseDevice(device); }
  };
  std::unique_ptr<std::atomic<std::ptrdiff_t>> bytes_ = std::make_unique<std::atomic<std::ptrdiff_t>>(0);
  std::unique_ptr<std::remove_pointer_t<RTCDevice>, Release> device_;
};

struct EmbreeSettings {
  RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
  RTCSceneFlags flags = RTC_SCENE_FLAG_NONE;
  RTCBuildQuality mesh_quality = quality;
};

/// What makes Embree refit. It looks at the quality of a mesh only where that of the scene is low: each mesh then has a
/// tree of its own.
inline constexpr EmbreeSettings embree_refits{RTC_BUILD_QUALITY_LOW, RTC_SCENE_FLAG_DYNAMIC, RTC_BUILD_QUALITY_REFIT};

[[nodiscard]] inline RTCRay embree_ray(const Ray<float>& ray) noexcept {
  RTCRay result;
  result.org_x = ray.origin.x;
  result.org_y = ray.origin.y;
  result.org_z = ray.origin.z;
  result.tnear = ray.t_min;
  result.dir_x = ray.direction.x;
  result.dir_y = ray.direction.y;
  result.dir_z = ray.direction.z;
  result.time = 0;
  result.tfar = ray.t_max;
  result.mask = std::numeric_limits<unsigned>::max();
  result.id = 0;
  result.flags = 0;
  return result;
}

/// What a ray meets first in a scene; nothing where geomID says so.
[[nodiscard]] inline RTCRayHit closest_in(RTCScene scene, const Ray<float>& ray) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit found;
  found.ray = embree_ray(ray);
  found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &found);
  return found;
}

[[nodiscard]] inline bool occluded_in(RTCScene scene, const Ray<float>& ray) noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay query = embree_ray(ray);
  rtcOccluded1(scene, &context, &query);
  return query.tfar < 0;
}

struct ReleaseScene {
  void operator()(RTCScene scene) const noexcept { rtcReleaseScene(scene); }
};
using EmbreeScene = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// A committed scene of one mesh, which Embree reads where it is. Models RayCaster.
///
/// Requires: the last vertex is nobody's: Embree reads sixteen bytes of each vertex.
class EmbreeCaster {
 public:
  using Scalar = float;
  using Index = std::uint32_t;

  EmbreeCaster(const EmbreeDevice& device, const MeshBuffers<float>& mesh, EmbreeSettings settings = {})
      : bytes_(-device.bytes()), scene_(rtcNewScene(device.handle())) {
    rtcSetSceneBuildQuality(scene_.get(), settings.quality);
    rtcSetSceneFlags(scene_.get(), settings.flags);
    const RTCGeometry geometry = rtcNewGeometry(device.handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetGeometryBuildQuality(geometry, settings.mesh_quality);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions.data(), 0,
                               sizeof(Vec3<float>), mesh.positions.size() - 1);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh.indices.data(), 0,
                               3 * sizeof(std::uint32_t), mesh.indices.size() / 3);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_.get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_.get());
    device.throw_errors();
    bytes_ += device.bytes();
  }

  [[nodiscard]] RTCScene handle() const noexcept { return scene_.get(); }
  /// What the scene takes beside the mesh.
  [[nodiscard]] std::size_t bytes() const noexcept { return static_cast<std::size_t>(bytes_); }

  [[nodiscard]] Aabb<float> bounds() const noexcept {
    RTCBounds box;
    rtcGetSceneBounds(scene_.get(), &box);
    return {{box.lower_x, box.lower_y, box.lower_z}, {box.upper_x, box.upper_y, box.upper_z}};
  }

  [[nodiscard]] std::optional<Hit<float>> closest(const Ray<float>& ray) const noexcept {
    const RTCRayHit found = closest_in(scene_.get(), ray);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Hit<float>{.t = found.ray.tfar, .uv = {found.hit.u, found.hit.v}, .primitive = found.hit.primID};
  }
  [[nodiscard]] bool occluded(const Ray<float>& ray) const noexcept { return occluded_in(scene_.get(), ray); }

  /// Follows vertices that moved.
  void commit_moved() const noexcept {
    const RTCGeometry geometry = rtcGetGeometry(scene_.get(), 0);
    rtcUpdateGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0);
    rtcCommitGeometry(geometry);
    rtcCommitScene(scene_.get());
  }

 private:
  std::ptrdiff_t bytes_;
  EmbreeScene scene_;
};

}  // namespace glint::bench

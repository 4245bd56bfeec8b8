// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <embree3/rtcore.h>

#include <glint/geometry/hit.hpp>
#include <glint/geometry/ray.hpp>

#include <peers/embree.hpp>

namespace glint::bench {

/// Casts many rays at a scene of Embree's, eight at a time.
class EmbreePackets {
 public:
  EmbreePackets(std::shared_ptr<const EmbreeCaster> caster, RTCIntersectContextFlags flags)
      : caster_(std::move(caster)), flags_(flags) {}

  [[nodiscard]] std::size_t bytes() const noexcept { return caster_->bytes(); }
  [[nodiscard]] std::optional<Hit<float>> closest(const Ray<float>& ray) const noexcept {
    return caster_->closest(ray);
  }

  void closest(std::span<const Ray<float>> rays, std::span<std::optional<Hit<float>>> hits) const noexcept {
    RTCIntersectContext context = fresh_context();
    for (std::size_t first = 0; first < rays.size(); first += width_) {
      const std::size_t count = std::min(width_, rays.size() - first);
      RTCRayHit8 found;
      const Valid valid = gather(rays.subspan(first, count), found.ray);
      std::fill(std::begin(found.hit.geomID), std::end(found.hit.geomID), RTC_INVALID_GEOMETRY_ID);
      rtcIntersect8(valid.lanes, caster_->handle(), &context, &found);
      for (std::size_t i = 0; i < count; ++i) {
        std::optional<Hit<float>>& hit = hits[first + i];
        hit.reset();
        if (found.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID) continue;
        hit = Hit<float>{
            .t = found.ray.tfar[i], .uv = {found.hit.u[i], found.hit.v[i]}, .primitive = found.hit.primID[i]};
      }
    }
  }

  void occluded(std::span<const Ray<float>> rays, std::span<bool> results) const noexcept {
    RTCIntersectContext context = fresh_context();
    for (std::size_t first = 0; first < rays.size(); first += width_) {
      const std::size_t count = std::min(width_, rays.size() - first);
      RTCRay8 packet;
      const Valid valid = gather(rays.subspan(first, count), packet);
      rtcOccluded8(valid.lanes, caster_->handle(), &context, &packet);
      for (std::size_t i = 0; i < count; ++i) results[first + i] = packet.tfar[i] < 0;
    }
  }

 private:
  static constexpr std::size_t width_ = 8;

  /// −1 for a ray, 0 for none.
  struct alignas(32) Valid {
    int lanes[width_];
  };

  [[nodiscard]] RTCIntersectContext fresh_context() const noexcept {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = flags_;
    return context;
  }

  [[nodiscard]] static Valid gather(std::span<const Ray<float>> rays, RTCRay8& packet) noexcept {
    Valid valid;
    for (std::size_t i = 0; i < width_; ++i) {
      valid.lanes[i] = i < rays.size() ? -1 : 0;
      const Ray<float>& ray = rays[std::min(i, rays.size() - 1)];
      packet.org_x[i] = ray.origin.x;
      packet.org_y[i] = ray.origin.y;
      packet.org_z[i] = ray.origin.z;
      packet.tnear[i] = ray.t_min;
      packet.dir_x[i] = ray.direction.x;
      packet.dir_y[i] = ray.direction.y;
      packet.dir_z[i] = ray.direction.z;
      packet.time[i] = 0;
      packet.tfar[i] = ray.t_max;
      packet.mask[i] = std::numeric_limits<unsigned>::max();
      packet.id[i] = 0;
      packet.flags[i] = 0;
    }
    return valid;
  }

  std::shared_ptr<const EmbreeCaster> caster_;
  RTCIntersectContextFlags flags_;
};

}  // namespace glint::bench

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glint/geometry/mesh_buffers.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/random.hpp>
#include <glint/math/vec.hpp>

#include <support/mesh_parts.hpp>
#include <support/named_mesh.hpp>

/// A hall: walls of two triangles next to railings of thousands, as in the atria that renderers are shown with.
namespace glint::bench {

namespace detail {

/// A hall is 30 long, 14 wide and 12 high, centered in x and z, in meters.
class Hall {
 public:
  explicit Hall(float detail) : detail_(detail) {}

  [[nodiscard]] MeshBuffers<float> make() {
    add_walls();
    for (const float side : {-1.0F, 1.0F}) {
      add_colonnade(side);
      add_railing(side);
      add_curtains(side);
    }
    add_vault();
    add_clutter();
    add_plants();
    return std::move(mesh_);
  }

 private:
  /// How finely something round is cut.
  [[nodiscard]] int cuts(int n) const { return std::max(3, int(float(n) * detail_)); }
  [[nodiscard]] float uniform(float low, float high) { return random_.uniform(low, high); }

  void add_walls() {
    add_quad(mesh_, {-15, 0, -7}, {30, 0, 0}, {0, 0, 14});
    for (const float z : {-7.0F, 7.0F}) add_quad(mesh_, {-15, 0, z}, {30, 0, 0}, {0, 9, 0});
    for (const float x : {-15.0F, 15.0F}) add_quad(mesh_, {x, 0, -7}, {0, 0, 14}, {0, 12, 0});
    for (const float z : {-7.0F, 4.0F}) add_box(mesh_, {-15, 5, z}, {30, 0, 0}, {0, 0.4F, 0}, {0, 0, 3});
  }

  void add_colonnade(float side) {
    for (int i = 0; i < 8; ++i) {
      const float x = -14 + 4 * float(i);
      add_column({x, 0, side * 4.2F}, 3.4F, 48);
      add_column({x, 5.4F, side * 4.2F}, 2.6F, 32);
      if (i < 7) add_arch(x, side * 4.2F);
    }
  }

  /// A base of rings, a fluted shaft of long thin triangles, a capital.
  void add_column(const Vec3<float>& base, float height, int around) {
    add_box(mesh_, base - Vec3<float>{0.45F, 0, 0.45F}, {0.9F, 0, 0}, {0, 0.15F, 0}, {0, 0, 0.9F});
    for (const float y : {0.15F, height - 0.35F}) {
      Outline rings;
      const int rows = cuts(12);
      for (int i = 0; i <= rows; ++i) {
        const float s = float(i) / float(rows);
        rings.emplace_back(0.32F + 0.09F * std::abs(std::sin(3 * pi<float> * s)), y + 0.3F * s);
      }
      add_turned(mesh_, base, rings, 1, cuts(around));
    }
    add_grid(mesh_, 1, cuts(2 * around), [&](float s, float t) {
      const float angle = 2 * pi<float> * t;
      const float radius = 0.3F - 0.04F * s + 0.015F * std::cos(20 * angle);
      return base + Vec3<float>{radius * std::cos(angle), 0.45F + (height - 0.8F) * s, radius * std::sin(angle)};
    });
  }

  void add_arch(float x, float z) {
    const auto point = [&](float radius, float t, float across) {
      const float angle = pi<float> * t;
      return Vec3<float>{x + 2 - radius * std::cos(angle), 3.4F + 0.8F * radius * std::sin(angle), z + across};
    };
    for (const float radius : {1.6F, 1.95F})
      add_grid(mesh_, 2, cuts(32), [&](float s, float t) { return point(radius, t, 0.7F * s - 0.35F); });
    for (const float across : {-0.35F, 0.35F})
      add_grid(mesh_, 2, cuts(32), [&](float s, float t) { return point(1.6F + 0.35F * s, t, across); });
  }

  void add_railing(float side) {
    const float z = side * 3.9F;
    add_box(mesh_, {-15, 6.35F, z - 0.12F}, {30, 0, 0}, {0, 0.12F, 0}, {0, 0, 0.24F});
    Outline baluster;
    const int rows = cuts(16);
    for (int i = 0; i <= rows; ++i) {
      const float s = float(i) / float(rows);
      baluster.emplace_back(0.045F + 0.035F * std::sin(5 * pi<float> * s * s), 5.4F + 0.95F * s);
    }
    for (int i = 0; i < 96; ++i) add_turned(mesh_, {-14.7F + 0.31F * float(i), 0, z}, baluster, 1, cuts(14));
  }

  void add_curtains(float side) {
    for (int i = 0; i < 3; ++i) {
      const float x = -13.5F + 8 * float(i);
      add_grid(mesh_, cuts(40), cuts(60), [&](float s, float t) {
        const float wave = 0.12F * std::sin(26 * t + 3 * s) * (0.4F + s) + 0.05F * std::sin(61 * t - 5 * s);
        return Vec3<float>{x + 3 * t + 0.1F * wave, 4.9F - 3.2F * s, side * 4.2F + wave};
      });
    }
  }

  void add_vault() {
    add_grid(mesh_, 6, cuts(40), [&](float s, float t) {
      const float angle = pi<float> * t;
      return Vec3<float>{-15 + 30 * s, 9 + 3 * std::sin(angle), -7 * std::cos(angle)};
    });
  }

  void add_clutter() {
    for (int i = 0; i < 36; ++i) {
      Outline vase;
      const int rows = cuts(24);
      const float belly = uniform(0.5F, 1.5F);
      for (int k = 0; k <= rows; ++k) {
        const float s = float(k) / float(rows);
        vase.emplace_back(0.08F + 0.12F * std::sin(belly + 3.3F * s) * std::sin(belly + 3.3F * s), 0.6F * s);
      }
      add_turned(mesh_, {uniform(-14, 14), 0, uniform(-6, 6)}, vase, uniform(0.3F, 1.6F), cuts(28));
    }
    for (int i = 0; i < 400; ++i) {
      const float angle = uniform(0, 2 * pi<float>);
      const float size = 0.03F + 0.5F * uniform(0, 1) * uniform(0, 1) * uniform(0, 1);
      const Vec3<float> u{size * std::cos(angle), 0, size * std::sin(angle)};
      const Vec3<float> v{-u.z * uniform(0.2F, 1.0F), 0, u.x};
      add_box(mesh_, {uniform(-14, 14), 0, uniform(-6, 6)}, u, v, {0, size * uniform(0.1F, 1.5F), 0});
    }
  }

  void add_plants() {
    for (int plant = 0; plant < 24; ++plant) {
      const Vec3<float> base{uniform(-14, 14), 0, uniform(-6, 6)};
      for (int leaf = 0; leaf < int(400 * detail_ * detail_) + 1; ++leaf) {
        const float angle = uniform(0, 2 * pi<float>);
        const float height = uniform(0.1F, 1.3F);
        const Vec3<float> out{std::cos(angle), 0, std::sin(angle)};
        const Vec3<float> across{-0.03F * out.z, 0.01F, 0.03F * out.x};
        const Vec3<float> root = base + out * uniform(0.05F, 0.4F) + Vec3<float>{0, height, 0};
        add_quad(mesh_, root, out * 0.09F + across, out * 0.09F - across);
      }
    }
  }

  MeshBuffers<float> mesh_;
  Random random_{6};
  float detail_;
};

}  // namespace detail

/// About so many triangles, if they are not too few for a hall.
[[nodiscard]] inline MeshBuffers<float> interior(std::size_t triangles) {
  return detail::Hall(std::sqrt(float(triangles) / 250'000)).make();
}

[[nodiscard]] inline Viewpoint interior_view() {
  return {.eye = {-13, 1.8F, -1.5F}, .target = {0, 3.2F, 0.8F}, .light = {2, 8.5F, 0.5F}, .half_width = 0.75F};
}

}  // namespace glint::bench

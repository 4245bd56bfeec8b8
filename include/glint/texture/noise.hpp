// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <glint/math/random.hpp>
#include <glint/texture/concepts.hpp>

namespace glint {

namespace detail {

/// How far a point goes along the direction that belongs to a lattice point: one of the twelve from a cube's center to
/// the middles of its edges. `d` leads from the lattice point to the point.
[[nodiscard]] inline float along_lattice_gradient(std::uint64_t lattice_point, const Vec3<float>& d) noexcept {
  const auto edge = static_cast<unsigned>((mix(lattice_point) >> 32) * 12 >> 32);
  const float a = edge < 4 ? d.y : d.x;
  const float b = edge < 8 ? d.z : d.y;
  return ((edge & 1) != 0 ? -a : a) + ((edge & 2) != 0 ? -b : b);
}

/// One axis of a lattice cell: the keys of its two ends, where in it a coordinate is, and the weight of the far end.
struct LatticeAxis {
  std::array<std::uint64_t, 2> keys{};
  float from_near = 0;
  float weight = 0;

  /// Floats from 2²³ on are whole numbers; they, and NaN, all count as one lattice point.
  LatticeAxis(float x, std::uint64_t multiplier) noexcept {
    if (!(std::abs(x) < 0x1p23F)) x = 0;
    const float below = std::floor(x);
    const auto cell = static_cast<std::uint64_t>(static_cast<std::int64_t>(below));
    keys = {cell * multiplier, (cell + 1) * multiplier};
    const float t = x - below;
    from_near = t;
    weight = t * t * t * (t * (6 * t - 15) + 10);  // neither slope nor curvature at the ends
  }
};

}  // namespace detail

/// Smooth noise: zero at whole coordinates, in between up and down by random slopes, features about one unit wide.
///
/// Ensures:  within ±2, and hardly ever beyond ±1; the mean is zero; slope and curvature are continuous.
/// Errors:   a coordinate that is not finite, or from 2²³ on, counts as zero.
/// Source:   Perlin, "Improving Noise", SIGGRAPH 2002. The slopes are chosen by a hash in place of a table, so that the
///           noise does not repeat after 256 units, and each of the twelve is as likely as the others.
[[nodiscard]] inline float gradient_noise(const Vec3<float>& p, std::uint64_t seed = 0) noexcept {
  const detail::LatticeAxis x(p.x, 0x9E3779B97F4A7C15U);
  const detail::LatticeAxis y(p.y, 0xC2B2AE3D27D4EB4FU);
  const detail::LatticeAxis z(p.z, 0x165667B19E3779F9U);
  const std::uint64_t key = mix(seed);
  const auto corner = [&](unsigned i, unsigned j, unsigned k) {
    const Vec3<float> d{x.from_near - static_cast<float>(i), y.from_near - static_cast<float>(j),
                        z.from_near - static_cast<float>(k)};
    return detail::along_lattice_gradient(key + x.keys[i] + y.keys[j] + z.keys[k], d);
  };
  const auto between = [](float a, float b, float weight) { return a + weight * (b - a); };
  const auto edge = [&](unsigned j, unsigned k) { return between(corner(0, j, k), corner(1, j, k), x.weight); };
  const auto face = [&](unsigned k) { return between(edge(0, k), edge(1, k), y.weight); };
  return between(face(0), face(1), z.weight);
}

/// Noise of several frequencies, one upon the other.
///
/// Requires: count ≥ 1; gain ≥ 0.
struct Octaves {
  int count = 4;
  float gain = 0.5F;         ///< how strong each is against the one before
  float lacunarity = 1.99F;  ///< how many times finer it is; at 2, the zeros of all would fall together
  std::uint64_t seed = 0;

  [[nodiscard]] friend bool operator==(const Octaves&, const Octaves&) noexcept = default;
};

namespace detail {

/// The mean of the octaves, weighted by strength, each as `shape` makes it.
template <typename Shape>
[[nodiscard]] float mean_of_octaves(Vec3<float> p, const Octaves& octaves, const Shape& shape) {
  float sum = 0;
  float strengths = 0;
  float strength = 1;
  for (int i = 0; i < octaves.count; ++i) {
    sum += strength * shape(gradient_noise(p, octaves.seed + static_cast<std::uint64_t>(i)));
    strengths += strength;
    strength *= octaves.gain;
    p *= octaves.lacunarity;
  }
  return sum / strengths;
}

}  // namespace detail

/// Fractional Brownian motion, the look of clouds: the weighted mean of octaves, so with the bounds of the noise.
///
/// Source: Ebert, Musgrave, Peachey, Perlin, Worley, Texturing and Modeling, 3rd edition (2003), chapters 2 and 16.
[[nodiscard]] inline float fbm(const Vec3<float>& p, const Octaves& octaves = {}) noexcept {
  return detail::mean_of_octaves(p, octaves, [](float noise) { return noise; });
}

/// The same of absolute values, with creases where the noise is zero: from 0 up, marble and flames.
[[nodiscard]] inline float turbulence(const Vec3<float>& p, const Octaves& octaves = {}) noexcept {
  return detail::mean_of_octaves(p, octaves, [](float noise) { return std::abs(noise); });
}

enum class NoisePattern : std::uint8_t { Fbm, Turbulence };

/// Two colors, mixed by noise over the position: solid, so that it needs no texture coordinates and has no seams.
///
/// Fbm goes from color 0 at −1 to color 1 at 1, turbulence from color 0 at 0 to color 1 at 1; both are held there.
/// By coordinates alone, u and v stand for x and y, at z = 0.
///
/// Units: scale: noise units a scene unit, along each axis; offset: noise units.
struct NoiseTexture {
  Rgb color0{0};
  Rgb color1{1};
  Vec3<float> scale{1.0F};
  Vec3<float> offset{0.0F};
  Octaves octaves{};
  NoisePattern pattern = NoisePattern::Fbm;

  [[nodiscard]] Rgb evaluate(const Surface& at) const noexcept { return color(at.position); }
  [[nodiscard]] Rgb evaluate(const Vec2<float>& uv) const noexcept { return color({uv.x, uv.y, 0.0F}); }

  [[nodiscard]] friend bool operator==(const NoiseTexture&, const NoiseTexture&) noexcept = default;

 private:
  [[nodiscard]] Rgb color(const Vec3<float>& p) const noexcept {
    const Vec3<float> at = scale * p + offset;
    const float share = pattern == NoisePattern::Fbm ? 0.5F + 0.5F * fbm(at, octaves) : turbulence(at, octaves);
    return color0 + Rgb(std::clamp(share, 0.0F, 1.0F)) * (color1 - color0);
  }
};

static_assert(Texture<NoiseTexture> && SurfaceTexture<NoiseTexture>);

}  // namespace glint

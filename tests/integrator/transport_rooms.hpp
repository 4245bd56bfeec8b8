// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <integrator/rooms.hpp>

#include <glint/camera/orthographic.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/film/film.hpp>
#include <glint/render/render.hpp>

/// The walls of a room, and a lamp below its ceiling that faces down.
inline std::vector<glint::Quad<float>> lamp_room() {
  auto walls = room_walls();
  walls.push_back({{-0.3F, 0.9F, -0.3F}, {0.6F, 0, 0}, {0, 0, 0.6F}});
  return walls;
}

/// The last of the walls shines.
inline glint::Lights<glint::AreaLight<glint::Quad<float>>> lamp_of(const std::vector<glint::Quad<float>>& walls) {
  glint::Lights<glint::AreaLight<glint::Quad<float>>> lights{{{walls.back(), glint::Rgb{10}}},
                                                             std::vector(walls.size(), glint::none<std::uint32_t>)};
  lights.of_primitive.back() = 0;
  return lights;
}

/// The means of parts of an image over several renderings with independent noise, and their errors.
struct BlockMeans {
  struct Block {
    double mean = 0;
    double error = 0;
  };
  std::vector<Block> blocks;
};

/// Renders an image of 8 × 8 pixels `runs` times with different seeds; blocks are its quarters, and the whole.
template <typename I, typename S, typename C>
BlockMeans block_means(const I& integrator, const S& scene, const C& camera, int samples, int runs,
                       std::uint64_t first_seed) {
  constexpr int edge = 8;
  std::vector<double> sums(5, 0.0);
  std::vector<double> squares(5, 0.0);
  for (int run = 0; run < runs; ++run) {
    glint::Film film{{edge, edge}};
    const auto report = glint::render(scene, camera, integrator, film, {.samples = samples}, glint::Serial{},
                                      glint::Independent{.seed = first_seed + static_cast<std::uint64_t>(run)});
    if (report.dropped != 0) return {};
    const glint::Image image = film.develop();
    std::vector<double> means(5, 0.0);
    for (int y = 0; y < edge; ++y) {
      for (int x = 0; x < edge; ++x) {
        const double value = static_cast<double>(image(x, y).g);
        means[static_cast<std::size_t>(2 * (y / (edge / 2)) + x / (edge / 2))] += value / 16;
        means[4] += value / 64;
      }
    }
    for (std::size_t i = 0; i < means.size(); ++i) {
      sums[i] += means[i];
      squares[i] += means[i] * means[i];
    }
  }
  BlockMeans result;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double mean = sums[i] / runs;
    const double variance = std::max(0.0, squares[i] / runs - mean * mean) * runs / (runs - 1);
    result.blocks.push_back({mean, std::sqrt(variance / runs)});
  }
  return result;
}

/// The largest difference of two images' blocks in standard errors.
inline double largest_z(const BlockMeans& a, const BlockMeans& b) {
  if (a.blocks.empty() || b.blocks.empty()) return glint::infinity<double>;
  double largest = 0;
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    const double error = std::hypot(a.blocks[i].error, b.blocks[i].error);
    const double rounding = 1e-5 * std::abs(a.blocks[i].mean);
    largest = std::max(
        largest, std::max(0.0, std::abs(a.blocks[i].mean - b.blocks[i].mean) - rounding) / std::max(error, 1e-12));
  }
  return largest;
}

/// The radiance of a floor of reflectance ρ, averaged over a square window of half width `window` below the center of a
/// square lamp of half width 1 and radiance 1 at height 2, by Lambert's formula for the irradiance of a polygon: an
/// element whose normal meets a corner of a parallel rectangle, x by y at unit height, receives
/// (x atan(y / √(1 + x²)) / √(1 + x²) + y atan(x / √(1 + y²)) / √(1 + y²)) / 2.
inline double floor_below_lamp(double reflectance, double window) {
  const auto by_corner = [](double x, double y) {
    const double u = std::sqrt(1 + x * x);
    const double v = std::sqrt(1 + y * y);
    return 0.5 * (x / u * std::atan(y / u) + y / v * std::atan(x / v));
  };
  constexpr int points = 32;
  double sum = 0;
  for (int i = 0; i < points * points; ++i) {
    const int row = i / points;
    const double x = window * ((i % points + 0.5) / points * 2 - 1);
    const double y = window * ((row + 0.5) / points * 2 - 1);
    for (const double right : {1 - x, 1 + x}) {
      for (const double up : {1 - y, 1 + y}) sum += by_corner(right / 2, up / 2);
    }
  }
  return reflectance / glint::pi<double> * sum / (points * points);
}

/// That floor and lamp, and the floor's window as a camera sees it from below the lamp.
struct FloorBelowLamp {
  std::vector<glint::Quad<float>> quads{{{-3, 0, -3}, {0, 0, 6}, {6, 0, 0}}, {{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}};
  glint::Orthographic camera{.eye = {0, 1, 0}, .target = {0, 0, 0}, .up = {0, 0, -1}, .height = 1};

  [[nodiscard]] auto scene() const {
    const glint::Lights<glint::AreaLight<glint::Quad<float>>> lights{{{quads[1], glint::Rgb{1}}},
                                                                     {glint::none<std::uint32_t>, 0}};
    return glint::Scene{glint::Bvh{glint::Elements{quads}}, glint::Lambertian{glint::Rgb{0.5F}}, lights};
  }
};

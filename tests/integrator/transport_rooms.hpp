// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <integrator/rooms.hpp>

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

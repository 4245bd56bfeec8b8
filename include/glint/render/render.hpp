// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include <glint/camera/concepts.hpp>
#include <glint/core/executor.hpp>
#include <glint/film/film.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/render/options.hpp>
#include <glint/render/report.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/counted.hpp>

namespace glint {

namespace detail {

/// Adds all samples of one film block's pixels, until stopped.
template <SceneLike S, RayGenerator G, typename I, typename Block, SampleSequence Q>
[[nodiscard]] RenderReport render_block(const S& scene, const G& generator, const I& integrator, Block block,
                                        Vec2i film_size, const RenderOptions& options, const Q& sequence) {
  RenderReport report;
  const Counted counted{scene, report.rays};
  const Vec2<float> scale = Vec2<float>(1) / Vec2<float>(film_size);
  const auto [begin, end] = block.pixels();
  for (int y = begin.y; y < end.y; ++y) {
    for (int x = begin.x; x < end.x; ++x) {
      if (options.stop.stop_requested()) {
        report.complete = false;
        return report;
      }
      for (int sample = 0; sample < options.samples; ++sample) {
        auto sampler = sequence.stream(Vec2i{x, y}, sample);
        const Vec2<float> jitter = sampler.next_2d();
        const Vec2<float> lens = sampler.next_2d();
        const Vec2<float> at = Vec2<float>{x, y} + jitter;
        const Ray<float> ray = generator.ray(Vec2<float>{at.x * scale.x, 1 - at.y * scale.y}, lens);
        const Rgb value = integrator.radiance(counted, ray, sampler);
        report.dropped += block.add(at, value) ? 0U : 1U;
      }
      report.samples += static_cast<std::uint64_t>(options.samples);
    }
  }
  return report;
}

/// Tells the user how far things are, one thread at a time.
class ProgressTeller {
 public:
  ProgressTeller(const RenderOptions& options, std::uint64_t total) : options_(options), total_(total) {}

  void advance(std::uint64_t samples) {
    if (!options_.progress) return;
    const std::scoped_lock lock(mutex_);
    done_ += samples;
    options_.progress({done_, total_, seconds()});
  }

  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  const RenderOptions& options_;
  std::uint64_t total_;
  std::uint64_t done_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
};

}  // namespace detail

/// Renders a scene: for every pixel, `options.samples` camera paths whose values are added to the film.
///
/// The image is a function of scene, camera, integrator, film and sequence alone: the same bits for every executor,
/// number of threads and tile size.
///
/// Requires: options.samples ≥ 0, options.tile_size ≥ 1; nobody else uses the film meanwhile.
/// Errors:   values that are not finite are left out and counted. What the progress callback throws ends the rendering
///           and comes out here.
/// Threads:  those of the executor.
template <SceneLike S, Camera C, typename I, typename F, Executor E = Serial, SampleSequence Q = Independent>
RenderReport render(const S& scene, const C& camera, const I& integrator, Film<F>& film,
                    const RenderOptions& options = {}, const E& executor = {}, const Q& sequence = {}) {
  const Vec2i size = film.size();
  const auto generator = camera.rays(static_cast<float>(size.x) / static_cast<float>(size.y));
  const Vec2i blocks = film.block_grid();
  const int blocks_a_tile = std::max(1, (options.tile_size + Film<F>::block_size - 1) / Film<F>::block_size);
  const Vec2i tiles = (blocks + Vec2i(blocks_a_tile - 1)) / Vec2i(blocks_a_tile);

  std::vector<RenderReport> reports(static_cast<std::size_t>(tiles.x) * static_cast<std::size_t>(tiles.y));
  detail::ProgressTeller teller(options, static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
                                             static_cast<std::uint64_t>(options.samples));
  const auto render_tile = [&](std::size_t tile) {
    const Vec2i begin = Vec2i{static_cast<int>(tile) % tiles.x, static_cast<int>(tile) / tiles.x} * blocks_a_tile;
    for (int y = begin.y; y < std::min(begin.y + blocks_a_tile, blocks.y); ++y) {
      for (int x = begin.x; x < std::min(begin.x + blocks_a_tile, blocks.x); ++x) {
        reports[tile] += detail::render_block(
            scene, generator, integrator,
            film.block(static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks.x) + static_cast<std::size_t>(x)),
            size, options, sequence);
      }
    }
    if (reports[tile].complete) teller.advance(reports[tile].samples);
  };
  executor.parallel_for(reports.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t tile = first; tile < last; ++tile) render_tile(tile);
  });

  RenderReport total;
  for (const RenderReport& report : reports) total += report;
  total.seconds = teller.seconds();
  return total;
}

}  // namespace glint

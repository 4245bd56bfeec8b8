// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/camera/concepts.hpp>
#include <glint/camera/neighbor_rays.hpp>
#include <glint/camera/shutter.hpp>
#include <glint/core/executor.hpp>
#include <glint/film/film.hpp>
#include <glint/film/splats.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/render/options.hpp>
#include <glint/render/report.hpp>
#include <glint/sampler/concepts.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/at_time.hpp>
#include <glint/scene/counted.hpp>
#include <glint/scene/path_footprint.hpp>

namespace glint {

namespace detail {

/// What all samples of a rendering have in common. A value of references: it lives as long as one call of render.
template <SceneLike S, RayGenerator G, typename I, SampleSequence Q>
struct RenderTask {
  using Stream = decltype(std::declval<const Q&>().stream(Vec2i{}, 0));
  using Seen = std::conditional_t<TimedRayGenerator<G>, AtTime<S>, S>;
  static constexpr bool splats = SplattingIntegratorFor<I, Counted<Seen>, Stream, G>;

  const S& scene;
  const G& generator;
  const I& integrator;
  const Q& sequence;
  const RenderOptions& options;
  Vec2i film_size;
  Splats* splats_to;  ///< null where the integrator does not splat

  /// Adds all samples of one pixel; false, and nothing added, once the rendering is to stop.
  template <typename Block>
  [[nodiscard]] bool render_pixel(Block& block, Vec2i pixel, RenderReport& report) const {
    if (options.stop.stop_requested()) return false;
    const Vec2<float> scale = Vec2<float>(1) / Vec2<float>(film_size);
    const Vec2<float> step = scale * footprint_width();
    for (int sample = 0; sample < options.samples; ++sample) {
      auto sampler = sequence.stream(pixel, sample);
      const Vec2<float> jitter = sampler.next_2d();
      const Vec2<float> lens = sampler.next_2d();
      const Vec2<float> at = Vec2<float>(pixel) + jitter;
      const Vec2<float> film{at.x * scale.x, 1 - at.y * scale.y};
      const Rgb value = seen_through(film, lens, sampler, report, footprint(film, lens, step));
      report.dropped += block.add(at, value) ? 0U : 1U;
    }
    report.samples += static_cast<std::uint64_t>(options.samples);
    return true;
  }

  /// How much of a pixel one of its paths stands for, across and up.
  [[nodiscard]] float footprint_width() const noexcept {
    return options.footprint * std::max(0.125F, 1 / std::sqrt(static_cast<float>(std::max(1, options.samples))));
  }

  /// The footprint with which a path starts: none where the scene does not ask.
  [[nodiscard]] auto footprint(const Vec2<float>& film, const Vec2<float>& lens, const Vec2<float>& step) const {
    if constexpr (FilteringScene<S>) {
      return options.footprint > 0 ? PathFootprint(ray_differential(generator, film, lens, step)) : PathFootprint();
    } else {
      return NoFootprint{};
    }
  }

  /// The radiance along a ray of the camera: at the ray's time, which is drawn where there is a shutter.
  template <typename R, typename P>
  [[nodiscard]] Rgb seen_through(const Vec2<float>& film, const Vec2<float>& lens, R& sampler, RenderReport& report,
                                 const P& path) const {
    if constexpr (TimedRayGenerator<G>) {
      const Ray<float> ray = generator.ray(film, lens, sampler.next_1d());
      const AtTime now{scene, ray.time};
      return radiance(Counted{now, report.rays}, ray, sampler, report, path);
    } else {
      return radiance(Counted{scene, report.rays}, generator.ray(film, lens), sampler, report, path);
    }
  }

  template <typename R, typename P>
  [[nodiscard]] Rgb radiance(const Counted<Seen>& counted, const Ray<float>& ray, R& sampler, RenderReport& report,
                             const P& path) const {
    if constexpr (splats) {
      const auto splat = [&](const Vec2<float>& film, const Rgb& value) {
        const Vec2i pixel = Vec2i(Vec2<float>{film.x, 1 - film.y} * Vec2<float>(film_size));
        const Vec2i in_image{std::min(pixel.x, film_size.x - 1), std::min(pixel.y, film_size.y - 1)};
        report.dropped += splats_to->add(in_image, value) ? 0U : 1U;
      };
      if constexpr (requires { integrator.radiance(counted, ray, sampler, generator, splat, path); }) {
        return integrator.radiance(counted, ray, sampler, generator, splat, path);
      } else {
        return integrator.radiance(counted, ray, sampler, generator, splat);
      }
    } else if constexpr (requires { integrator.radiance(counted, ray, sampler, path); }) {
      return integrator.radiance(counted, ray, sampler, path);
    } else {
      return integrator.radiance(counted, ray, sampler);
    }
  }

  /// Renders a film block pixel by pixel, until stopped.
  template <typename Block>
  void render_block(Block block, RenderReport& report) const {
    const auto [begin, end] = block.pixels();
    for (int y = begin.y; y < end.y && report.complete; ++y) {
      for (int x = begin.x; x < end.x && report.complete; ++x) report.complete = render_pixel(block, {x, y}, report);
    }
  }
};

/// A film's blocks in square groups, which is how they are handed to threads.
class Tiles {
 public:
  Tiles(Vec2i blocks, int blocks_a_tile)
      : blocks_(blocks), edge_(blocks_a_tile), grid_((blocks + Vec2i(edge_ - 1)) / Vec2i(edge_)) {}

  [[nodiscard]] std::size_t count() const noexcept {
    return static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.y);
  }

  /// Calls f with the number of each block of a tile.
  template <typename F>
  void for_each_block(std::size_t tile, const F& f) const {
    const Vec2i begin = Vec2i{static_cast<int>(tile) % grid_.x, static_cast<int>(tile) / grid_.x} * edge_;
    for (int y = begin.y; y < std::min(begin.y + edge_, blocks_.y); ++y) {
      for (int x = begin.x; x < std::min(begin.x + edge_, blocks_.x); ++x) {
        f(static_cast<std::size_t>(y) * static_cast<std::size_t>(blocks_.x) + static_cast<std::size_t>(x));
      }
    }
  }

 private:
  Vec2i blocks_;
  int edge_;
  Vec2i grid_;
};

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

/// Renders a scene: for every pixel, `options.samples` camera paths whose values are added to the film, and with an
/// integrator that splats (SplattingIntegratorFor) as many light paths, which go to any pixel.
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
  const auto& ready = prepared(integrator, scene);
  using Task = detail::RenderTask<S, std::remove_cvref_t<decltype(generator)>, std::remove_cvref_t<decltype(ready)>, Q>;
  Splats* splats = nullptr;
  if constexpr (Task::splats) splats = &film.splats();
  const Task task{scene, generator, ready, sequence, options, size, splats};
  const detail::Tiles tiles(film.block_grid(),
                            std::max(1, (options.tile_size + Film<F>::block_size - 1) / Film<F>::block_size));
  std::vector<RenderReport> reports(tiles.count());
  detail::ProgressTeller teller(options, static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
                                             static_cast<std::uint64_t>(options.samples));
  const auto render_tile = [&](std::size_t tile) {
    tiles.for_each_block(tile, [&](std::size_t block) { task.render_block(film.block(block), reports[tile]); });
    if (reports[tile].complete) teller.advance(reports[tile].samples);
  };
  executor.parallel_for(reports.size(), 1, [&](std::size_t first, std::size_t last) {
    for (std::size_t tile = first; tile < last; ++tile) render_tile(tile);
  });

  RenderReport total;
  for (const RenderReport& report : reports) total += report;
  if constexpr (Task::splats) film.count_splatting_paths(total.samples);
  total.seconds = teller.seconds();
  return total;
}

}  // namespace glint

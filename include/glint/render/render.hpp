// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <chrono>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <type_traits>
#include <utility>
#include <vector>

#include <glint/camera/concepts.hpp>
#include <glint/camera/neighbor_rays.hpp>
#include <glint/camera/shutter.hpp>
#include <glint/core/config.hpp>
#include <glint/core/executor.hpp>
#include <glint/film/film.hpp>
#include <glint/film/splats.hpp>
#include <glint/integrator/aov_layers.hpp>
#include <glint/integrator/concepts.hpp>
#include <glint/integrator/light_shares.hpp>
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
template <SceneLike S, RayGenerator G, typename I, SampleSequence Q, typename A>
struct RenderTask {
  using Stream = decltype(std::declval<const Q&>().stream(Vec2i{}, 0));
  using Seen = std::conditional_t<TimedRayGenerator<G>, AtTime<S>, S>;
  static constexpr bool splats = SplattingIntegratorFor<I, Counted<Seen>, Stream, G>;
  static constexpr bool has_layers = !std::same_as<A, NoLayers>;
  static_assert(!splats || !A::has_variance, "the samples of a pixel do not tell the variance of light that splats");

  const S& scene;
  const G& generator;
  const I& integrator;
  const Q& sequence;
  const RenderOptions& options;
  Vec2i film_size;
  Vec2<float> scale;  ///< from raster positions to film positions
  Splats* splats_to;  ///< null where the integrator does not splat
  A& layers;

  /// Adds all samples of one pixel; false, and nothing added, once the rendering is to stop.
  template <typename Block>
  [[nodiscard]] bool render_pixel(Block& block, Vec2i pixel, RenderReport& report) const {
    if (options.stop.stop_requested()) return false;
    const Vec2<float> step = scale * footprint_width();
    auto gathered = layers.pixel(pixel);
    for (int sample = 0; sample < options.samples; ++sample) {
      const bool added = add_sample(block, gathered, pixel, sample, step, report);
      report.dropped += added ? 0U : 1U;
    }
    if constexpr (has_layers) write(gathered, pixel, report);
    report.samples += static_cast<std::uint64_t>(options.samples);
    return true;
  }

  /// Adds one sample of a pixel to the film, and to the layers; false, and nothing added, where the film drops it.
  template <typename Block, typename Gathered>
  [[nodiscard]] bool add_sample(Block& block, Gathered& gathered, Vec2i pixel, int sample, const Vec2<float>& step,
                                RenderReport& report) const {
    auto sampler = sequence.stream(pixel, sample);
    const Vec2<float> jitter = sampler.next_2d();
    const Vec2<float> lens = sampler.next_2d();
    const Vec2<float> at = Vec2<float>(pixel) + jitter;
    const Vec2<float> film = film_position(at);
    const auto path = footprint(film, lens, step);
    return with_ray(film, lens, sampler, report, [&](const Counted<Seen>& counted, const Ray<float>& ray) {
      if constexpr (has_layers) {
        const Stream from_here = sampler;
        const LightShares light = shares(counted, ray, sampler, report, path);
        if (!block.add(at, light.sum)) return false;
        gathered.add(counted, ray, from_here, light);
        return true;
      } else {
        return block.add(at, radiance(counted, ray, sampler, report, path));
      }
    });
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

  /// Where a raster position is on the film.
  [[nodiscard]] Vec2<float> film_position(const Vec2<float>& at) const noexcept {
    return {at.x * scale.x, 1 - at.y * scale.y};
  }

  /// Calls f with the scene and the camera's ray: at the ray's time, which is drawn where there is a shutter.
  template <typename R, typename F>
  auto with_ray(const Vec2<float>& film, const Vec2<float>& lens, R& sampler, RenderReport& report, const F& f) const {
    if constexpr (TimedRayGenerator<G>) {
      const Ray<float> ray = generator.ray(film, lens, sampler.next_1d());
      const AtTime now{scene, ray.time};
      return f(Counted{now, report.rays}, ray);
    } else {
      return f(Counted{scene, report.rays}, generator.ray(film, lens));
    }
  }

  /// Writes a pixel's layers.
  template <typename Gathered>
  void write(const Gathered& gathered, Vec2i pixel, RenderReport& report) const {
    if constexpr (Gathered::template has_ids<Counted<Seen>>) {
      if (gathered.template asks_for_hit<Counted<Seen>>()) return write_with_ids(gathered, pixel, report);
    }
    gathered.write();
  }

  /// Likewise, with the ids in its center, in the middle of the time that a shutter is open.
  template <typename Gathered>
  void write_with_ids(const Gathered& gathered, Vec2i pixel, RenderReport& report) const {
    struct Middle {
      [[nodiscard]] static float next_1d() noexcept { return 0.5F; }
    };
    Middle middle;
    const Vec2<float> center = film_position(Vec2<float>(pixel) + Vec2<float>(0.5F));
    with_ray(center, Vec2<float>(0.5F), middle, report, [&](const Counted<Seen>& counted, const Ray<float>& ray) {
      gathered.write(counted, counted.closest(ray));
    });
  }

  /// What a sample brings, in shares where the integrator tells.
  template <typename R, typename P>
  [[nodiscard]] LightShares shares(const Counted<Seen>& counted, const Ray<float>& ray, R& sampler,
                                   RenderReport& report, const P& path) const {
    if constexpr (A::has_light) {
      return light_shares(integrator, counted, ray, sampler, path);
    } else {
      return {.sum = radiance(counted, ray, sampler, report, path)};
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

/// The rendering of both forms of render().
template <SceneLike S, Camera C, typename I, typename F, typename A, Executor E, SampleSequence Q>
RenderReport render_all(const S& scene, const C& camera, const I& integrator, Film<F>& film, A& layers,
                        const RenderOptions& options, const E& executor, const Q& sequence) {
  const Vec2i size = film.size();
  const auto generator = camera.rays(static_cast<float>(size.x) / static_cast<float>(size.y));
  const auto& ready = prepared(integrator, scene);
  using Task = RenderTask<S, std::remove_cvref_t<decltype(generator)>, std::remove_cvref_t<decltype(ready)>, Q, A>;
  Splats* splats = nullptr;
  if constexpr (Task::splats) splats = &film.splats();
  const Task task{scene, generator, ready, sequence, options, size, Vec2<float>(1) / Vec2<float>(size), splats, layers};
  const Tiles tiles(film.block_grid(),
                    std::max(1, (options.tile_size + Film<F>::block_size - 1) / Film<F>::block_size));
  std::vector<RenderReport> reports(tiles.count());
  ProgressTeller teller(options, static_cast<std::uint64_t>(size.x) * static_cast<std::uint64_t>(size.y) *
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
  if constexpr (requires { integrator.clamp.is_on(); }) total.clamped = integrator.clamp.is_on();
  total.seconds = teller.seconds();
  return total;
}

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
  NoLayers none;
  return detail::render_all(scene, camera, integrator, film, none, options, executor, sequence);
}

/// The same, with output variables (Aov) beside the film.
///
/// The film's image has the same bits as without. Layers show the samples of this rendering alone, also where the film
/// has gathered others before.
///
/// Requires: layers.size() == film.size(). Variables of light (LightAov) ask for an integrator that tells light by the
///           length of its path (TermwiseIntegratorFor); aov::Variance for one that does not splat.
template <SceneLike S, Camera C, typename I, typename F, Aov... As, Executor E = Serial, SampleSequence Q = Independent>
RenderReport render(const S& scene, const C& camera, const I& integrator, Film<F>& film, AovLayers<As...>& layers,
                    const RenderOptions& options = {}, const E& executor = {}, const Q& sequence = {}) {
  GLINT_ASSERT(layers.size() == film.size());
  return detail::render_all(scene, camera, integrator, film, layers, options, executor, sequence);
}

}  // namespace glint

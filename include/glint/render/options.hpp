// SPDX-License-Identifier: MIT
#pragma once
#include <cstdint>
#include <functional>
#include <stop_token>

namespace glint {

/// How far rendering has come.
struct RenderProgress {
  std::uint64_t samples_done = 0;
  std::uint64_t samples_total = 0;
  double seconds = 0;  ///< since the start
};

struct RenderOptions {
  int samples = 16;  ///< camera paths a pixel
  /// How wide paths are that start at the camera: 1 is their share of the pixel (but an eighth of it at least), 0
  /// leaves textures unfiltered. Without effect, and without cost, where no texture of the scene can be filtered.
  float footprint = 1;

  int tile_size = 32;  ///< edge of the squares that are handed to threads, in pixels; rounded up to whole film blocks

  /// Called after each tile, one call at a time, from whichever thread finished it. It should be quick.
  std::function<void(const RenderProgress&)> progress{};

  /// Ends the rendering early, each thread after the pixel it is at; the others stay as they were.
  std::stop_token stop{};
};

}  // namespace glint

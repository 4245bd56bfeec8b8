// SPDX-License-Identifier: MIT
#pragma once
#include <glint/bsdf/concepts.hpp>

namespace glint {

/// What a path, begun at the camera or at a light, must remember so that multiple importance sampling can weigh it
/// against all other ways to make the same whole path: sums of ratios of densities, squared as the power heuristic has
/// it. Each step multiplies and adds; no weight needs a walk back.
///
/// Vertices are numbered from the path's own end. All cosines are magnitudes, to geometric normals.
///
/// Source: Veach (1997), chapter 10; van Antwerpen, "Unbiased Physically Based Rendering on the GPU" (2011), and
///         Georgiev, "Implementing Vertex Connection and Merging" (2012), for the recursion.
struct PathDensities {
  double last = 0;     ///< of the way that connects to the last vertex but one, over this
  double earlier = 0;  ///< of all ways that connect to vertices before it, over this, and over the squared density of
                       ///< the step back from the last vertex

  [[nodiscard]] static constexpr double squared(double x) noexcept { return x * x; }

  /// At the next vertex: from solid angle to area.
  constexpr void arrive(double squared_distance, double cosine) noexcept {
    const double by_cosine = 1 / squared(cosine);
    last *= squared(squared_distance) * by_cosine;
    earlier *= by_cosine;
  }

  /// In a direction drawn from the BSDF; `pdf_reverse` is the density of having drawn the way back to where it came
  /// from. Nothing else finds a specular direction, and the way back is as likely.
  constexpr void leave(const BsdfSample& scattered, double cosine, double pdf_reverse) noexcept {
    if (scattered.lobe == Lobe::Specular) {
      earlier *= squared(cosine);
      last = 0;
      return;
    }
    const double by_pdf = 1 / squared(static_cast<double>(scattered.pdf));
    earlier = squared(cosine) * by_pdf * (earlier * squared(pdf_reverse) + last);
    last = by_pdf;
  }

  /// All ways in which the other end reaches further into this path, over the one at hand, which connects to its last
  /// vertex: `pdf` is the density by area with which the other end finds that vertex.
  [[nodiscard]] constexpr double others(double pdf, double pdf_reverse) const noexcept {
    return squared(pdf) * (last + earlier * squared(pdf_reverse));
  }

  /// The same where the path has itself met the other end: a light that is chosen with density `direct` by surfaces,
  /// and emits the ray met with density `emitted`.
  [[nodiscard]] constexpr double others_at_end(double direct, double emitted) const noexcept {
    return squared(direct) * last + squared(emitted) * earlier;
  }
};

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>

#include <glint/math/vec.hpp>

namespace glint {

/// The random numbers of one camera path, dimension after dimension, each in [0, 1).
///
/// Draw one number a statement: the order in which arguments of one call are evaluated is unspecified.
template <typename S>
concept Sampler = requires(S& sampler) {
  { sampler.next_1d() } -> std::same_as<float>;
  { sampler.next_2d() } -> std::same_as<Vec2<float>>;
};

/// All paths' random numbers: `stream(pixel, sample)` is a pure function of its arguments and the sequence's seed, so
/// that an image does not depend on threads or on the order of pixels.
template <typename Q>
concept SampleSequence = requires(const Q& sequence, const Vec2i& pixel, int sample) {
  { sequence.stream(pixel, sample) } -> Sampler;
};

}  // namespace glint

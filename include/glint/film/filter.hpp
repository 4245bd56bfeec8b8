// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <concepts>

#include <glint/math/vec.hpp>

namespace glint {

/// How much a sample counts in a pixel, by its offset from the pixel's center in pixels (x right, y down). The weight
/// is zero where |x| or |y| exceeds the radius, a member or, as in OneOf, a member function. Weights need no common
/// scale: the film divides by their sum.
template <typename F>
concept Filter = requires(const F& filter, const Vec2<float>& offset) {
  { filter.evaluate(offset) } -> std::same_as<float>;
}
&&(
    requires(const F& filter) {
      { filter.radius } -> std::convertible_to<float>;
    } ||
    requires(const F& filter) {
      { filter.radius() } -> std::convertible_to<float>;
    });

/// A filter that is the product of one function, its profile, along both axes: evaluate({x, y}) = p(x) p(y) where
/// p = profile(). A film then evaluates it once a row and once a column rather than once a pixel.
template <typename F>
concept SeparableFilter = Filter<F> && requires(const F& filter, float offset) {
  { filter.profile()(offset) } -> std::same_as<float>;
};

/// The radius of any filter, in pixels.
template <Filter F>
[[nodiscard]] constexpr float filter_radius(const F& filter) noexcept {
  if constexpr (requires { filter.radius(); }) {
    return filter.radius();
  } else {
    return filter.radius;
  }
}

namespace detail {

template <typename F>
[[nodiscard]] float evaluate_separable(const F& filter, const Vec2<float>& offset) noexcept {
  const auto profile = filter.profile();
  return profile(offset.x) * profile(offset.y);
}

}  // namespace detail

/// Equal weights. The default gives each sample to the pixel that holds it: no pixel shares noise with another.
struct BoxFilter {
  float radius = 0.5F;

  [[nodiscard]] auto profile() const noexcept {
    return [r = radius](float x) { return std::abs(x) <= r ? 1.0F : 0.0F; };
  }
  [[nodiscard]] float evaluate(const Vec2<float>& offset) const noexcept {
    return detail::evaluate_separable(*this, offset);
  }

  [[nodiscard]] friend bool operator==(const BoxFilter&, const BoxFilter&) noexcept = default;
};

/// Weights that fall linearly: 1 − |x| / radius along each axis.
struct TentFilter {
  float radius = 1;

  [[nodiscard]] auto profile() const noexcept {
    return [r = radius, slope = 1 / radius](float x) { return std::abs(x) <= r ? 1 - std::abs(x) * slope : 0.0F; };
  }
  [[nodiscard]] float evaluate(const Vec2<float>& offset) const noexcept {
    return detail::evaluate_separable(*this, offset);
  }

  [[nodiscard]] friend bool operator==(const TentFilter&, const TentFilter&) noexcept = default;
};

/// A bell, lowered so that it ends at zero: exp(−α x²) − exp(−α radius²) along each axis.
struct GaussianFilter {
  float radius = 1.5F;
  float alpha = 2;  ///< 1 / (2 σ²)

  [[nodiscard]] auto profile() const noexcept {
    return [r = radius, a = alpha, end = std::exp(-alpha * radius * radius)](float x) {
      return std::abs(x) <= r ? std::max(0.0F, std::exp(-a * x * x) - end) : 0.0F;
    };
  }
  [[nodiscard]] float evaluate(const Vec2<float>& offset) const noexcept {
    return detail::evaluate_separable(*this, offset);
  }

  [[nodiscard]] friend bool operator==(const GaussianFilter&, const GaussianFilter&) noexcept = default;
};

/// The family of cubics with parameters B (blur) and C (ringing), stretched so that its support [−2, 2] becomes
/// [−radius, radius]. Some weights are negative: sharper images, and halos around lights.
///
/// Source: Mitchell, Netravali, "Reconstruction Filters in Computer Graphics", SIGGRAPH 1988, equation 8.
struct MitchellFilter {
  float radius = 2;
  float b = 1.0F / 3;
  float c = 1.0F / 3;

  [[nodiscard]] auto profile() const noexcept {
    return [scale = 2 / radius, B = b, C = c](float x) {
      const float d = std::abs(x) * scale;
      if (d <= 1) {
        return (((12 - 9 * B - 6 * C) * d + (-18 + 12 * B + 6 * C)) * d * d + (6 - 2 * B)) * (1.0F / 6);
      }
      const float e = 2 - d;  // with its double root at d = 2 taken out, so that the end is exactly zero
      return d <= 2 ? e * e * ((B + 6 * C) * e - 6 * C) * (1.0F / 6) : 0.0F;
    };
  }
  [[nodiscard]] float evaluate(const Vec2<float>& offset) const noexcept {
    return detail::evaluate_separable(*this, offset);
  }

  [[nodiscard]] friend bool operator==(const MitchellFilter&, const MitchellFilter&) noexcept = default;
};

static_assert(SeparableFilter<BoxFilter> && SeparableFilter<TentFilter>);
static_assert(SeparableFilter<GaussianFilter> && SeparableFilter<MitchellFilter>);

}  // namespace glint

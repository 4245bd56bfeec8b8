// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <glint/color/layers.hpp>
#include <glint/core/index.hpp>
#include <glint/integrator/aov.hpp>

namespace glint {

namespace detail {

/// A value of an output variable as the numbers of its channels.
[[nodiscard]] constexpr std::array<float, 1> components(float x) noexcept {
  return {x};
}
[[nodiscard]] constexpr std::array<float, 2> components(const Vec2<float>& v) noexcept {
  return {v.x, v.y};
}
[[nodiscard]] constexpr std::array<float, 3> components(const Vec3<float>& v) noexcept {
  return {v.x, v.y, v.z};
}
[[nodiscard]] constexpr std::array<float, 3> components(const Rgb& c) noexcept {
  return {c.r, c.g, c.b};
}
[[nodiscard]] constexpr std::array<std::uint32_t, 1> components(std::uint32_t i) noexcept {
  return {i};
}

/// The mean of values of up to three numbers.
class MeanOfValues {
 public:
  /// Leaves out what is not finite.
  template <typename V>
  void add(const V& value) noexcept {
    const auto numbers = components(value);
    if (!std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) return;
    ++count_;
    for (std::size_t c = 0; c < numbers.size(); ++c) sum_[c] += static_cast<double>(numbers[c]);
  }

  [[nodiscard]] bool is_empty() const noexcept { return count_ == 0; }
  /// Requires: there are any.
  template <std::size_t N>
  [[nodiscard]] std::array<float, N> mean() const noexcept {
    std::array<float, N> result{};
    for (std::size_t c = 0; c < N; ++c) result[c] = static_cast<float>(sum_[c] / static_cast<double>(count_));
    return result;
  }

 private:
  std::array<double, 3> sum_{};
  std::uint32_t count_ = 0;
};

}  // namespace detail

/// Gathers output variables (Aov) beside a film, each as a layer of its own: see `render`. A rendering begins anew;
/// what a pixel shows depends on its own samples alone, so that the layers are the same for any number of threads.
///
/// All variables of the type's list are there, or those that were chosen by name: the others cost nothing but the
/// question whether they are.
///
/// Requires: size ≥ 0; no two variables have the same channel.
/// Cost:     4 bytes a pixel for each channel; a ray a sample where there are variables of surfaces, a ray a pixel
///           where there are ids.
/// Threads:  different pixels may be gathered at once.
template <Aov... As>
class AovLayers {
 public:
  static constexpr std::array<std::string_view, sizeof...(As)> names{As::name...};
  static constexpr bool has_light = (LightAov<As> || ...);
  static constexpr bool has_variance = (std::same_as<As, aov::Variance> || ...);

  explicit AovLayers(Vec2i size, As... aovs) : aovs_(std::move(aovs)...), layers_{size} {
    for_each([&](auto i, const auto& aov) { add_channels<i>(aov); });
  }

  /// Those of the names; names that are none of `names` choose nothing.
  AovLayers(Vec2i size, const std::vector<std::string>& chosen) : layers_{size} {
    for_each([&](auto i, const auto& aov) {
      if (std::find(chosen.begin(), chosen.end(), aov.name) != chosen.end()) add_channels<i>(aov);
    });
  }

  [[nodiscard]] Vec2i size() const noexcept { return layers_.size; }

  /// What was gathered; zero where nothing was.
  [[nodiscard]] const Layers& layers() const& noexcept { return layers_; }
  [[nodiscard]] Layers layers() && noexcept { return std::move(layers_); }

  /// The samples of one pixel, until they are written.
  class Pixel {
   public:
    /// Adds a sample: its ray, what the integrator began with, and the light it brought.
    template <SceneLike S, Sampler R>
      requires((LightAov<As> || SamplesAov<As> || SurfaceAovFor<As, S, R> || IdAovFor<As, S>)&&...)
    void add(const S& scene, const Ray<float>& ray, const R& sampler, const LightShares& light) {
      statistics_.add(light.sum);
      to_->for_each_chosen([&](auto i, const auto& aov) {
        if constexpr (LightAov<std::remove_cvref_t<decltype(aov)>>) means_[i].add(aov.of_light(light));
      });
      if constexpr ((SurfaceAovFor<As, S, R> || ...)) {
        if (to_->template chosen<OfSurfaces<S, R>>()) add_surface(scene, ray, sampler);
      }
    }

    template <SceneLike S>
    static constexpr bool has_ids = (IdAovFor<As, S> || ...);

    /// Whether `write` asks what the ray through the pixel's center meets.
    template <SceneLike S>
    [[nodiscard]] bool asks_for_hit() const noexcept {
      return to_->template chosen<Ids<S>>();
    }

    /// Writes the means of what was added. Requires: `asks_for_hit` is false.
    void write() const {
      to_->for_each_chosen([&](auto i, const auto& aov) { write_statistics<i>(aov); });
    }

    /// Writes the means of what was added, and the ids of what the ray through the pixel's center meets.
    template <SceneLike S, typename H>
    void write(const S& scene, const H& hit) const {
      write();
      to_->for_each_chosen([&](auto i, const auto& aov) {
        if constexpr (IdAovFor<std::remove_cvref_t<decltype(aov)>, S>) store<i>(detail::components(aov.id(scene, hit)));
      });
    }

   private:
    friend AovLayers;
    Pixel(AovLayers& to, std::size_t at) noexcept : to_(&to), at_(at) {}

    template <SceneLike S, Sampler R>
    void add_surface(const S& scene, const Ray<float>& ray, const R& sampler) {
      const auto at = scene.interact(ray);
      to_->for_each_chosen([&](auto i, const auto& aov) {
        if constexpr (SurfaceAovFor<std::remove_cvref_t<decltype(aov)>, S, R>) {
          if (const auto value = aov.at_surface(scene, ray, at, sampler)) means_[i].add(*value);
        }
      });
    }

    /// What is no id.
    template <std::size_t I, typename A>
    void write_statistics(const A& aov) const {
      if constexpr (SamplesAov<A>) {
        store<I>(detail::components(aov.of_samples(statistics_)));
      } else if constexpr (!std::is_integral_v<typename A::Value>) {
        if (!means_[I].is_empty()) return store<I>(means_[I].template mean<A::channels.size()>());
        if constexpr (requires { A::nowhere; })
          store<I>(detail::components(A::nowhere));
        else
          store<I>(detail::components(typename A::Value(0)));
      }
    }

    template <std::size_t I, typename T, std::size_t N>
    void store(const std::array<T, N>& numbers) const {
      for (std::size_t c = 0; c < N; ++c) {
        auto& channel = to_->layers_.channels[to_->first_channel_[I] + c];
        (*std::get_if<std::vector<T>>(&channel.values))[at_] = numbers[c];
      }
    }

    AovLayers* to_;
    std::size_t at_;
    SampleStatistics statistics_;
    std::array<detail::MeanOfValues, sizeof...(As)> means_{};
  };

  /// Requires: the pixel is in the picture.
  [[nodiscard]] Pixel pixel(Vec2i at) noexcept {
    return {*this,
            static_cast<std::size_t>(at.y) * static_cast<std::size_t>(layers_.size.x) + static_cast<std::size_t>(at.x)};
  }

 private:
  /// Kinds of variables, as predicates of their types.
  template <SceneLike S, Sampler R>
  struct OfSurfaces {
    template <typename A>
    static constexpr bool holds = SurfaceAovFor<A, S, R>;
  };
  template <SceneLike S>
  struct Ids {
    template <typename A>
    static constexpr bool holds = IdAovFor<A, S>;
  };

  /// Calls f(index as a constant, variable) for all of the list.
  template <typename F>
  void for_each(const F& f) const {
    [&]<std::size_t... I>(std::index_sequence<I...>) {
      (f(std::integral_constant<std::size_t, I>{}, std::get<I>(aovs_)), ...);
    }
    (std::index_sequence_for<As...>{});
  }
  template <typename F>
  void for_each_chosen(const F& f) const {
    for_each([&](auto i, const auto& aov) {
      if (first_channel_[i] != none<std::size_t>) f(i, aov);
    });
  }

  /// Whether any variable of a kind was chosen.
  template <typename Kind>
  [[nodiscard]] bool chosen() const noexcept {
    bool any = false;
    for_each_chosen([&](auto, const auto& aov) { any |= Kind::template holds<std::remove_cvref_t<decltype(aov)>>; });
    return any;
  }

  template <std::size_t I, typename A>
  void add_channels(const A& /*aov*/) {
    const auto pixels = static_cast<std::size_t>(layers_.size.x) * static_cast<std::size_t>(layers_.size.y);
    using Number = std::conditional_t<std::is_integral_v<typename A::Value>, std::uint32_t, float>;
    first_channel_[I] = layers_.channels.size();
    for (const std::string_view channel : A::channels) {
      layers_.channels.push_back({std::string(channel), std::vector<Number>(pixels)});
    }
  }

  [[nodiscard]] static constexpr auto no_channels() noexcept {
    std::array<std::size_t, sizeof...(As)> result{};
    result.fill(none<std::size_t>);
    return result;
  }

  std::tuple<As...> aovs_;
  Layers layers_;
  std::array<std::size_t, sizeof...(As)> first_channel_ = no_channels();
};

template <Aov... As>
AovLayers(Vec2i, As...) -> AovLayers<As...>;

/// In place of layers: none, at no cost.
struct NoLayers {
  static constexpr bool has_light = false;
  static constexpr bool has_variance = false;

  struct Pixel {};

  [[nodiscard]] static constexpr Pixel pixel(Vec2i /*at*/) noexcept { return {}; }
};

}  // namespace glint

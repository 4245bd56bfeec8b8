// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/motion.hpp>

namespace glint {

/// Several sets as one: the indices of the first come first, then those of the second, and so on. Sets are views and
/// are held by value; different kinds of primitives so share one tree.
///
/// Requires: the sizes of the sets do not change; an index can count them all.
/// Cost:     a comparison a set and intersection.
template <PrimitiveSet... Sets>
class Joined {
 public:
  static_assert(sizeof...(Sets) > 0, "Joined needs at least one set");
  using Scalar = typename std::tuple_element_t<0, std::tuple<Sets...>>::Scalar;
  using Index = std::common_type_t<typename Sets::Index...>;
  static_assert((std::same_as<Scalar, typename Sets::Scalar> && ...), "Joined sets must have the same scalar type");

  /// An element by the number of its set and its index there.
  struct Place {
    std::size_t set = 0;
    Index index = 0;

    [[nodiscard]] friend constexpr bool operator==(const Place&, const Place&) noexcept = default;
  };

  constexpr explicit Joined(Sets... sets) : sets_(std::move(sets)...) { count(std::index_sequence_for<Sets...>{}); }

  [[nodiscard]] constexpr std::size_t size() const noexcept { return begins_.back(); }

  [[nodiscard]] constexpr std::size_t inner_values() const noexcept {
    return std::apply([](const auto&... sets) { return std::max({glint::inner_values(sets)...}); }, sets_);
  }

  template <std::size_t N>
  [[nodiscard]] constexpr const auto& set() const noexcept {
    return std::get<N>(sets_);
  }

  /// Requires: i < size().
  [[nodiscard]] constexpr Place locate(Index i) const noexcept {
    return dispatch(i, []<std::size_t N>(Number<N>, const auto&, auto local) { return Place{N, Index(local)}; });
  }

  [[nodiscard]] Aabb<Scalar> bounds(Index i) const {
    return dispatch(i, []<std::size_t N>(Number<N>, const auto& set, auto local) { return set.bounds(local); });
  }

  /// Shows element i to `f(primitive)`; of a set that does not hand out its primitives, the box.
  template <typename F>
  auto with_primitive(Index i, const F& f) const {
    return dispatch(i, [&]<std::size_t N>(Number<N>, const auto& set, auto local) {
      if constexpr (requires { set.with_primitive(local, f); })
        return set.with_primitive(local, f);
      else
        return f(set.bounds(local));
    });
  }

  /// Of sets that stand still, the box twice.
  [[nodiscard]] MotionBounds<Scalar> motion_bounds(Index i) const requires(MovingSet<Sets> || ...) {
    return dispatch(
        i, []<std::size_t N>(Number<N>, const auto& set, auto local) { return glint::motion_bounds(set, local); });
  }

  /// Of sets that cannot clip, the part of the box.
  [[nodiscard]] Aabb<Scalar> clip(Index i, const Aabb<Scalar>& cell) const requires(ClippableSet<Sets> || ...) {
    return dispatch(i, [&]<std::size_t N>(Number<N>, const auto& set, auto local) {
      if constexpr (ClippableSet<std::remove_cvref_t<decltype(set)>>) {
        return set.clip(local, cell);
      } else {
        return overlap(set.bounds(local), cell);
      }
    });
  }

  [[nodiscard]] Vec3<Scalar> closest_point(const Vec3<Scalar>& point, Index i) const
      requires(ClosestPointSet<Sets>&&...) {
    return dispatch(
        i, [&]<std::size_t N>(Number<N>, const auto& set, auto local) { return set.closest_point(point, local); });
  }

  /// What each set prepares, and nothing for those that prepare nothing.
  [[nodiscard]] auto prepare(const Ray<Scalar>& ray) const {
    return std::apply([&](const auto&... sets) { return std::make_tuple(prepare_one(sets, ray)...); }, sets_);
  }

  template <typename Prepared>
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, const Prepared& prepared,
                                                            Index i) const {
    return dispatch(i, [&]<std::size_t N>(Number<N>, const auto& set, auto local) {
      if constexpr (PreparedSet<std::remove_cvref_t<decltype(set)>>) {
        return with_index(set.intersect(ray, std::get<N>(prepared), local), i);
      } else {
        return with_index(set.intersect(ray, local), i);
      }
    });
  }
  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, Index i) const {
    return dispatch(i, [&]<std::size_t N>(Number<N>, const auto& set, auto local) {
      return with_index(set.intersect(ray, local), i);
    });
  }

  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(ShadableSet<Sets>&&...) {
    return dispatch(hit.primitive, [&]<std::size_t N>(Number<N>, const auto& set, auto local) {
      using Local = typename std::remove_cvref_t<decltype(set)>::Index;
      const Local inner = hit.inner == none<Index> ? none<Local> : static_cast<Local>(hit.inner);
      return set.surface(ray, Hit<Scalar, Local>{hit.t, hit.uv, local, inner});
    });
  }

 private:
  template <std::size_t N>
  using Number = std::integral_constant<std::size_t, N>;
  struct Nothing {};

  template <std::size_t... N>
  constexpr void count(std::index_sequence<N...>) {
    ((begins_[N + 1] = static_cast<Index>(begins_[N] + static_cast<Index>(std::get<N>(sets_).size()))), ...);
    GLINT_ASSERT((std::size_t(0) + ... + std::get<N>(sets_).size()) < none<Index>);
  }

  template <typename Set>
  [[nodiscard]] static auto prepare_one(const Set& set, const Ray<Scalar>& ray) {
    if constexpr (PreparedSet<Set>) {
      return set.prepare(ray);
    } else {
      return Nothing{};
    }
  }

  /// A set's own hit with the index it has here.
  template <typename LocalHit>
  [[nodiscard]] static std::optional<Hit<Scalar, Index>> with_index(const std::optional<LocalHit>& hit, Index i) {
    if (!hit) return std::nullopt;
    using Local = decltype(hit->inner);
    const Index inner = hit->inner == none<Local> ? none<Index> : static_cast<Index>(hit->inner);
    return Hit<Scalar, Index>{hit->t, hit->uv, i, inner};
  }

  /// Calls f with the set that holds element i, and the element's index there.
  template <std::size_t N = 0, typename F>
  [[nodiscard]] constexpr auto dispatch(Index i, const F& f) const {
    if constexpr (N + 1 < sizeof...(Sets)) {
      if (i >= begins_[N + 1]) return dispatch<N + 1>(i, f);
    }
    using Local = typename std::tuple_element_t<N, std::tuple<Sets...>>::Index;
    return f(Number<N>{}, std::get<N>(sets_), static_cast<Local>(i - begins_[N]));
  }

  std::tuple<Sets...> sets_;
  std::array<Index, sizeof...(Sets) + 1> begins_{};
};

}  // namespace glint

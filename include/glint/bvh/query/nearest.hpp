// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The point of a primitive that is closest to a given one.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
struct ClosestPoint {
  Vec3<T> position{T(0)};
  T distance = infinity<T>;
  I primitive = none<I>;

  [[nodiscard]] friend bool operator==(const ClosestPoint&, const ClosestPoint&) noexcept = default;
};

/// The boxes within a distance of a point, the nearest first. Keys and limit are squared distances.
///
/// Ensures: no box is left out by rounding.
template <std::floating_point T, int N>
class PointQuery {
 public:
  static constexpr bool ordered = true;

  /// Requires: squares of distances are in T's range.
  PointQuery(const Vec3<T>& point, T squared_limit) noexcept
      : point_{P::broadcast(point.x), P::broadcast(point.y), P::broadcast(point.z)} {
    shrink(squared_limit);
  }

  [[nodiscard]] GLINT_ALWAYS_INLINE Entered<T, N> enter(const BoxPack<T, N>& boxes) const noexcept {
    const P x = outside(boxes, 0);
    const P y = outside(boxes, 1);
    const P z = outside(boxes, 2);
    const P squared = x * x + y * y + z * z;
    return {less_equal(squared, limits_), squared};
  }
  [[nodiscard]] T limit() const noexcept { return limit_; }
  /// The limit stays finite, for empty boxes are infinitely far.
  GLINT_ALWAYS_INLINE void shrink(T squared) noexcept {
    limit_ = std::min(squared * (T(1) + rounding_bound<T>(16)), std::numeric_limits<T>::max());
    limits_ = P::broadcast(limit_);
  }

 private:
  using P = Pack<T, N>;

  [[nodiscard]] GLINT_ALWAYS_INLINE P outside(const BoxPack<T, N>& boxes, std::size_t axis) const noexcept {
    return max(max(boxes.planes[axis] - point_[axis], point_[axis] - boxes.planes[axis + 3]), P::broadcast(T(0)));
  }

  std::array<P, 3> point_;
  P limits_;
  T limit_;
};

namespace detail {

/// A closest point while squares will do.
template <std::floating_point T, std::unsigned_integral I>
struct Candidate {
  Vec3<T> position;
  T squared;
  I primitive;

  [[nodiscard]] friend bool operator<(const Candidate& a, const Candidate& b) noexcept {
    return a.squared < b.squared || (a.squared == b.squared && a.primitive < b.primitive);
  }
};

template <ClosestPointSet S>
class NearestOne {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;

  NearestOne(const S& set, const Vec3<T>& point, T squared_limit) noexcept
      : set_(set), point_(point), best_{point, squared_limit, none<I>} {}

  [[nodiscard]] T limit() const noexcept { return best_.squared; }
  [[nodiscard]] const Candidate<T, I>& best() const noexcept { return best_; }
  GLINT_ALWAYS_INLINE void operator()(I i) {
    const Vec3<T> position = set_.closest_point(point_, i);
    const Candidate<T, I> candidate{position, length_squared(position - point_), i};
    if (candidate < best_) best_ = candidate;
  }

 private:
  const S& set_;
  const Vec3<T>& point_;
  Candidate<T, I> best_;
};

/// Keeps the nearest primitives, as a heap whose top is the farthest. Distances in it are squared.
template <ClosestPointSet S>
class NearestFew {
 public:
  using T = typename S::Scalar;
  using I = typename S::Index;
  using Found = ClosestPoint<T, I>;

  NearestFew(const S& set, const Vec3<T>& point, T squared_limit, std::span<Found> found, bool has_parts) noexcept
      : set_(set), point_(point), squared_limit_(squared_limit), found_(found), has_parts_(has_parts) {}

  [[nodiscard]] bool is_full() const noexcept { return size_ == found_.size(); }
  [[nodiscard]] T limit() const noexcept { return is_full() ? found_[0].distance : squared_limit_; }
  GLINT_ALWAYS_INLINE void operator()(I i) {
    const Vec3<T> position = set_.closest_point(point_, i);
    const Found candidate{position, length_squared(position - point_), i};
    if (!(candidate.distance <= squared_limit_) || (is_full() && !before(candidate, found_[0]))) return;
    if (has_parts_ && holds(i)) return;
    if (is_full())
      std::pop_heap(found_.begin(), found_.end(), before);
    else
      ++size_;
    found_[size_ - 1] = candidate;
    const auto kept = found_.first(size_);
    std::push_heap(kept.begin(), kept.end(), before);
  }
  std::size_t sort() noexcept {
    const auto kept = found_.first(size_);
    std::sort_heap(kept.begin(), kept.end(), before);
    for (Found& found : kept) found.distance = std::sqrt(found.distance);
    return size_;
  }

 private:
  [[nodiscard]] static bool before(const Found& a, const Found& b) noexcept {
    return a.distance < b.distance || (a.distance == b.distance && a.primitive < b.primitive);
  }
  [[nodiscard]] bool holds(I i) const noexcept {
    const auto kept = found_.first(size_);
    return std::any_of(kept.begin(), kept.end(), [i](const Found& found) { return found.primitive == i; });
  }

  const S& set_;
  const Vec3<T>& point_;
  T squared_limit_;
  std::span<Found> found_;
  std::size_t size_ = 0;
  bool has_parts_;
};

template <ClosestPointSet S, LayoutChoice L, typename Sink>
void search_near(const Bvh<S, L>& bvh, const Vec3<typename S::Scalar>& point, Sink& sink) {
  PointQuery<typename S::Scalar, Bvh<S, L>::Nodes::width> query(point, sink.limit());
  traverse(bvh.nodes(), query, [&](Slots<typename S::Index> slots) {
    bvh.leaves().for_each_near(bvh.set(), point, slots, sink);
    query.shrink(sink.limit());
    return Walk::Continue;
  });
}

}  // namespace detail

/// The point closest to `point` of all primitives; nothing where none is within `max_distance`.
///
///     if (const auto found = closest_point(bvh, point)) use(found->position, found->distance, found->primitive);
///
/// Requires: squares of distances are in the scalar's range.
/// Ensures:  the least distance, to rounding; of equals the one of the smallest index.
/// Errors:   none is found for a NaN. Triangles without area count where leaves keep them, and elsewhere do not.
/// Cost:     no allocation.
/// Threads:  may be called by many at once.
template <ClosestPointSet S, LayoutChoice L>
[[nodiscard]] auto closest_point(const Bvh<S, L>& bvh, const Vec3<typename S::Scalar>& point,
                                 typename S::Scalar max_distance = infinity<typename S::Scalar>)
    -> std::optional<ClosestPoint<typename S::Scalar, typename S::Index>> {
  detail::NearestOne<S> nearest(bvh.set(), point, max_distance * max_distance);
  detail::search_near(bvh, point, nearest);
  const auto& best = nearest.best();
  if (best.primitive == none<typename S::Index>) return std::nullopt;
  return {{best.position, std::sqrt(best.squared), best.primitive}};
}

/// The nearest primitives within `max_distance` of `point`, each by its closest point: as many as there is room for,
/// the nearest first. Returns how many there are.
///
///     std::array<glint::ClosestPoint<float>, 8> found;
///     const std::size_t count = nearest_primitives(bvh, point, found);
///
/// Requires, Ensures, Errors, Threads: as closest_point; each primitive once.
/// Cost:     no allocation.
template <ClosestPointSet S, LayoutChoice L>
std::size_t nearest_primitives(
    const Bvh<S, L>& bvh, const Vec3<typename S::Scalar>& point,
    std::type_identity_t<std::span<ClosestPoint<typename S::Scalar, typename S::Index>>> found,
    typename S::Scalar max_distance = infinity<typename S::Scalar>) {
  if (found.empty()) return 0;
  detail::NearestFew<S> nearest(bvh.set(), point, max_distance * max_distance, found, bvh.has_parts());
  detail::search_near(bvh, point, nearest);
  return nearest.sort();
}

}  // namespace glint

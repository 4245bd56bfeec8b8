// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>

namespace glint {

/// A view of boxes as a set: trees over things that only their owner knows how to intersect.
///
///     const auto tree = glint::SweepSah{}.build(glint::Boxes{boxes});
///
/// Requires: the boxes outlive the view.
template <std::floating_point T, std::unsigned_integral I = std::uint32_t>
class Boxes {
 public:
  using Scalar = T;
  using Index = I;

  Boxes() = default;
  explicit Boxes(std::span<const Aabb<T>> boxes) noexcept : boxes_(boxes) {}

  [[nodiscard]] std::size_t size() const noexcept { return boxes_.size(); }
  [[nodiscard]] Aabb<T> bounds(I i) const noexcept {
    GLINT_ASSERT(i < boxes_.size());
    return boxes_[i];
  }

 private:
  std::span<const Aabb<T>> boxes_;
};
template <std::floating_point T>
Boxes(const std::vector<Aabb<T>>&) -> Boxes<T>;
template <std::floating_point T, std::size_t N>
Boxes(std::span<Aabb<T>, N>) -> Boxes<T>;
template <std::floating_point T, std::size_t N>
Boxes(std::span<const Aabb<T>, N>) -> Boxes<T>;

static_assert(BoundedSet<Boxes<float>> && BoundedSet<Boxes<double>>);

}  // namespace glint

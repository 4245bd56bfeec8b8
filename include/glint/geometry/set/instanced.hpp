// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include <glint/core/index.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/transform.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

/// What can be placed in a scene: a ray caster over a set, a Bvh say.
template <typename G>
concept Placeable = RayCaster<G> && requires(const G& object) {
  { object.set().size() } -> std::convertible_to<std::size_t>;
};

/// An object where it stands. Make one with `place`.
///
/// Requires: `to_local` is the inverse of `to_world`; the object lives as long as this.
template <Placeable G>
struct Instance {
  const G* object = nullptr;
  Affine<typename G::Scalar> to_world{};
  Affine<typename G::Scalar> to_local{};
  Aabb<typename G::Scalar> bounds{};  ///< in the world; empty where nothing is ever hit
};

namespace detail {

/// A bound for the size of what a map's linear part makes of vectors, per axis.
template <std::floating_point T>
[[nodiscard]] Vec3<T> stretched(const Affine<T>& affine, const Vec3<T>& largest) noexcept {
  return abs(Vec3<T>(affine.linear[0])) * largest.x + abs(Vec3<T>(affine.linear[1])) * largest.y +
         abs(Vec3<T>(affine.linear[2])) * largest.z;
}

/// A box around an object's image: the object may know a closer one than that of its box.
template <Placeable G>
[[nodiscard]] Aabb<typename G::Scalar> image_of(const G& object, const Affine<typename G::Scalar>& to_world) {
  if constexpr (requires { object.image_bounds(to_world); })
    return object.image_bounds(to_world);
  else
    return transform(to_world, object.bounds());
}

/// A box around the image of what is in a box, and around it what is rounded on the way there and back.
template <std::floating_point T>
[[nodiscard]] Aabb<T> placed_bounds(const Affine<T>& to_world, const Affine<T>& to_local, const Aabb<T>& box,
                                    const Aabb<T>& image) noexcept {
  if (is_empty(image)) return {};
  const auto largest = [](const Aabb<T>& b) { return max(abs(b.lower), abs(b.upper)); };
  const Vec3<T> there = stretched(to_world, largest(box)) + abs(to_world.translation);
  const Vec3<T> back = stretched(to_local, largest(image)) + abs(to_local.translation);
  const Vec3<T> rounded = (there + stretched(to_world, back)) * rounding_bound<T>(16);
  return {image.lower - rounded, image.upper + rounded};
}

}  // namespace detail

/// Puts an object into the world by any affine map: turned, mirrored, scaled by what one likes along each axis.
///
/// Cost:   a microsecond or a few: its box in the world is put around the boxes in the upper levels of the object's
/// tree. Errors: a map that flattens space, or is not finite, gives an instance that is never hit.
template <Placeable G>
[[nodiscard]] Instance<G> place(const G& object, const Affine<typename G::Scalar>& to_world) noexcept {
  const auto to_local = inverse(to_world);
  if (!to_local) return {.object = &object, .to_world = to_world};
  const auto image = detail::image_of(object, to_world);
  return {&object, to_world, *to_local, detail::placed_bounds(to_world, *to_local, object.bounds(), image)};
}

/// Objects at many places as one set, each in memory once: a tree over them is the upper of two levels, and may be
/// placed again.
///
///     const std::vector<glint::Instance<Bvh<Mesh>>> stand{place(tree, here), place(tree, there)};
///     const glint::Bvh forest{glint::Instanced{stand}};
///
/// A hit's `primitive` is the index of the instance, so that all adaptors compose; its `inner` says which primitive of
/// the object that is, and `path` what that means where objects consist of instances. t means the same in all spaces.
/// A view: nothing is copied.
///
/// Requires: the instances and their objects outlive the view, and keep their sizes.
/// Errors:   std::length_error where `inner` has no room for every primitive of an object and of what is placed in it.
template <Placeable G>
class Instanced {
 public:
  using Scalar = typename G::Scalar;
  using Index = typename G::Index;

  explicit Instanced(std::span<const Instance<G>> instances) : instances_(instances) {
    std::size_t most = 0;
    for (const Instance<G>& instance : instances_) {
      most = std::max<std::size_t>(most, instance.object->set().size());
      stride_ = std::max(stride_, glint::inner_values(instance.object->set()));
    }
    if (instances_.size() >= none<Index> || most >= none<Index> / stride_)
      throw std::length_error("Instanced: nested objects have more primitives than an index can count; use 64 bits");
    inner_values_ = most * stride_ + 1;
  }

  [[nodiscard]] std::size_t size() const noexcept { return instances_.size(); }
  /// Requires: i < size().
  [[nodiscard]] const Instance<G>& operator[](Index i) const noexcept { return instances_[i]; }
  [[nodiscard]] Aabb<Scalar> bounds(Index i) const noexcept { return instances_[i].bounds; }
  template <typename F>
  auto with_primitive(Index i, const F& f) const {
    return f(instances_[i]);
  }

  [[nodiscard]] std::optional<Hit<Scalar, Index>> intersect(const Ray<Scalar>& ray, Index i) const {
    const Instance<G>& instance = instances_[i];
    if (is_empty(instance.bounds)) return std::nullopt;
    const auto hit = instance.object->closest(transform(instance.to_local, ray));
    if (!hit) return std::nullopt;
    const Index last = hit->inner == none<Index> ? Index(stride_ - 1) : hit->inner;
    return Hit<Scalar, Index>{hit->t, hit->uv, i, static_cast<Index>(hit->primitive * stride_ + last)};
  }
  /// Whether `intersect` finds something, and sooner.
  [[nodiscard]] bool occluded(const Ray<Scalar>& ray, Index i) const {
    const Instance<G>& instance = instances_[i];
    return !is_empty(instance.bounds) && instance.object->occluded(transform(instance.to_local, ray));
  }

  [[nodiscard]] SurfaceOf<Scalar> surface(const Ray<Scalar>& ray, const Hit<Scalar, Index>& hit) const
      requires(requires(const G& object) { object.surface(ray, hit); }) {
    const Instance<G>& instance = instances_[hit.primitive];
    const auto local = instance.object->surface(transform(instance.to_local, ray), within(hit));
    return transform(instance.to_world, instance.to_local, local);
  }

  /// The hit as the object itself reported it. Requires: a hit of this set.
  [[nodiscard]] Hit<Scalar, Index> within(const Hit<Scalar, Index>& hit) const noexcept {
    const auto last = static_cast<Index>(hit.inner % stride_);
    return {hit.t, hit.uv, static_cast<Index>(hit.inner / stride_), last == stride_ - 1 ? none<Index> : last};
  }

  /// What is hit, from the outside in: the instance, the instance in its object where that consists of such, and so
  /// on; last the primitive. Requires: a hit of this set. Cost: a small allocation.
  [[nodiscard]] std::vector<Index> path(const Hit<Scalar, Index>& hit) const {
    std::vector<Index> indices{hit.primitive};
    const Hit<Scalar, Index> local = within(hit);
    const auto& objects = instances_[hit.primitive].object->set();
    if constexpr (requires { objects.path(local); }) {
      const auto rest = objects.path(local);
      indices.insert(indices.end(), rest.begin(), rest.end());
    } else {
      indices.push_back(local.primitive);
    }
    return indices;
  }

  /// How many values `inner` may have, `none` among them: what an Instanced of objects with this set counts by.
  [[nodiscard]] std::size_t inner_values() const noexcept { return inner_values_; }

 private:
  std::span<const Instance<G>> instances_;
  std::size_t stride_ = 1;
  std::size_t inner_values_ = 1;
};

template <Placeable G>
explicit Instanced(const std::vector<Instance<G>>&) -> Instanced<G>;
template <Placeable G>
explicit Instanced(std::span<const Instance<G>>) -> Instanced<G>;

}  // namespace glint

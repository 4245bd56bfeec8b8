// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>

#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/region.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/config.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/transform.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The smallest boxes around the images of N boxes, up to rounding. What a lane without a box becomes means nothing.
template <std::floating_point T, int N>
[[nodiscard]] GLINT_ALWAYS_INLINE BoxPack<T, N> transform(const Affine<T>& affine,
                                                          const BoxPack<T, N>& boxes) noexcept {
  using P = Pack<T, N>;
  BoxPack<T, N> images;
  for (int row = 0; row < 3; ++row) {
    P lower = P::broadcast(T(0));
    P upper = lower;
    for (int axis = 0; axis < 3; ++axis) {
      const P coefficient = P::broadcast(component(Vec3<T>(affine.linear[axis]), row));
      const P a = coefficient * boxes.planes[std::size_t(axis)];
      const P b = coefficient * boxes.planes[std::size_t(axis) + 3];
      lower = lower + min(a, b);
      upper = upper + max(a, b);
    }
    const P offset = P::broadcast(component(affine.translation, row));
    images.planes[std::size_t(row)] = lower + offset;
    images.planes[std::size_t(row) + 3] = upper + offset;
  }
  return images;
}

namespace detail {

/// Grows a box by the images of what is below a node. What is inside it already is not looked into.
template <Layout L>
void extend_by_images(Aabb<typename L::Scalar>& image, const L& layout, typename L::Index node,
                      const Affine<typename L::Scalar>& affine, int levels) {
  using T = typename L::Scalar;
  const BoxPack<T, L::width>& boxes = layout.children(node);
  const BoxPack<T, L::width> images = transform(affine, boxes);
  std::uint32_t mask = lanes_of_boxes(boxes);
  while (mask != 0) {
    const std::size_t i = take_lowest(mask);
    const Aabb<T> one = box_in_lane(images, int(i));
    if (contains(image, one)) continue;
    const Link<typename L::Index> link = layout.links(node)[i];
    if (link.is_leaf() || levels == 1)
      extend(image, one);
    else
      extend_by_images(image, layout, link.first, affine, levels - 1);
  }
}

}  // namespace detail

/// A box around the image of all that a layout holds, by its boxes a few levels below the root: closer than the image
/// of the root's box under a map that turns, which sweeps corners where nothing is.
///
/// Requires: `bounds` is the root's box; levels > 0.
/// Ensures:  no part of a primitive's image is outside, up to the rounding of the map.
/// Cost:     at most width^levels boxes; two levels of eight take about a microsecond.
template <Layout L>
[[nodiscard]] Aabb<typename L::Scalar> image_bounds(const L& layout, const Aabb<typename L::Scalar>& bounds,
                                                    const Affine<typename L::Scalar>& affine, int levels = 2) {
  if (layout.empty() || layout.root().is_leaf()) return transform(affine, bounds);
  Aabb<typename L::Scalar> image;
  detail::extend_by_images(image, layout, layout.root().first, affine, levels);
  return image;
}

}  // namespace glint

// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/bvh/concepts.hpp>
#include <glint/bvh/query/nearest.hpp>
#include <glint/bvh/query/region.hpp>
#include <glint/bvh/traverse.hpp>
#include <glint/core/fixed_stack.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/geometry/concepts.hpp>
#include <glint/geometry/region.hpp>
#include <glint/geometry/triangle.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/rounding.hpp>
#include <glint/math/vec.hpp>
#include <glint/simd/pack.hpp>

namespace glint {

/// The solid angle under which a triangle is seen from a point: positive from its inner side, negative from its outer,
/// zero for a triangle without area.
///
/// Units:  steradians, in [−2π, 2π]. Of no meaning for a point of the triangle.
/// Source: Van Oosterom, Strackee, "The Solid Angle of a Plane Triangle", IEEE Transactions on Biomedical Engineering
///         30(2), 1983.
template <std::floating_point T>
[[nodiscard]] T signed_solid_angle(const Vec3<T>& point, const Triangle<T>& triangle) noexcept {
  using W = Wide<T>;
  const Vec3<W> from(point);
  const Vec3<W> a = Vec3<W>(triangle.v0) - from;
  const Vec3<W> b = Vec3<W>(triangle.v1) - from;
  const Vec3<W> c = Vec3<W>(triangle.v2) - from;
  const W length_a = std::sqrt(length_squared(a));
  const W length_b = std::sqrt(length_squared(b));
  const W length_c = std::sqrt(length_squared(c));
  const W volume = glm::dot(a, glm::cross(b, c));
  if (volume == W(0)) return T(0);
  return T(2 * std::atan2(volume, length_a * length_b * length_c + glm::dot(a, b) * length_c +
                                      glm::dot(b, c) * length_a + glm::dot(c, a) * length_b));
}

/// A set of triangles: a mesh.
template <typename S>
concept TriangleSet = PrimitiveSet<S> && requires(const S& set, typename S::Index i) {
  { set.triangle(i) } -> std::same_as<Triangle<typename S::Scalar>>;
};

/// How often the surface of a mesh goes around a point, for all points: 1 inside of a closed mesh and 0 outside;
/// between them where the mesh is open, and above them where it overlaps itself. Holes and gaps disturb it little, so
/// that it tells inside from outside of meshes that have no inside in the strict sense.
///
///     const glint::Winding winding{bvh};
///     if (winding.holds(point)) …
///
/// Far parts of the mesh are seen as dipoles: a part is far at more than `accuracy` times its radius.
///
/// Requires: the Bvh outlives this, unchanged; outer sides outward.
/// Ensures:  for a closed mesh, at the default accuracy of 2, numbers within a few hundredths of the exact ones. They
/// are
///           exact, to rounding, at an infinite accuracy.
/// Errors:   std::invalid_argument for a tree that has triangles in parts, which would count more than once. Triangles
///           that the tree leaves out do not count. Of no meaning on the surface.
/// Cost:     made in O(triangles); a number in about O(log triangles), or O(triangles) where exact.
/// Threads:  const means shareable.
/// Source:   Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside Segmentation Using Generalized Winding Numbers",
///           ACM Transactions on Graphics 32(4), 2013; Barill, Dickson, Schmidt, Levin, Jacobson, "Fast Winding Numbers
///           for Soups and Clouds", ACM Transactions on Graphics 37(4), 2018, of the first order.
template <TriangleSet S, LayoutChoice L>
class Winding {
 public:
  using Scalar = typename S::Scalar;
  using Index = typename S::Index;

  explicit Winding(const Bvh<S, L>& bvh, Scalar accuracy = 2) : bvh_(bvh), accuracy_(accuracy) {
    if (bvh.has_parts())
      throw std::invalid_argument(
          "Winding: the tree has triangles in parts; expected one whose builder leaves triangles whole");
    if (!bvh.nodes().empty()) summarize(bvh.nodes().root());
  }

  [[nodiscard]] const Bvh<S, L>& bvh() const noexcept { return bvh_; }

  [[nodiscard]] Scalar number(const Vec3<Scalar>& point) const {
    if (bvh_.nodes().empty()) return 0;
    double sum = 0;
    FixedStack<Link<Index>, std::size_t(Tree<Scalar, Index>::max_depth * (Nodes::width - 1) + 1)> pending;
    pending.push(bvh_.nodes().root());
    while (!pending.empty()) {
      const Link<Index> link = pending.pop();
      if (link.is_leaf()) {
        sum += seen_one_by_one(point, link.slots());
        continue;
      }
      const Children& children = children_[link.first];
      const auto& links = bvh_.nodes().links(link.first);
      std::uint32_t far = children.far_from(point);
      for (std::uint32_t near = children.present & ~far; near != 0;) pending.push(links[detail::take_lowest(near)]);
      while (far != 0) sum += children.seen(point, int(detail::take_lowest(far)));
    }
    return Scalar(sum / (4 * pi<double>));
  }

  /// Whether a point is inside: whether the surface goes around it more than half of once.
  [[nodiscard]] bool holds(const Vec3<Scalar>& point) const { return number(point) > Scalar(0.5); }

 private:
  using Nodes = typename Bvh<S, L>::Nodes;
  using P = Pack<Scalar, Nodes::width>;

  /// Dipoles for the children of a node.
  struct Children {
    std::array<P, 3> center;
    std::array<P, 3> normal;  ///< of the length of the area
    P squared_reach;          ///< beyond it the child is far
    std::uint32_t present = 0;

    [[nodiscard]] std::uint32_t far_from(const Vec3<Scalar>& point) const noexcept {
      const P x = center[0] - P::broadcast(point.x);
      const P y = center[1] - P::broadcast(point.y);
      const P z = center[2] - P::broadcast(point.z);
      return less(squared_reach, x * x + y * y + z * z) & present;
    }
    [[nodiscard]] double seen(const Vec3<Scalar>& point, int lane) const noexcept {
      const Vec3<double> way{double(center[0][lane]) - double(point.x), double(center[1][lane]) - double(point.y),
                             double(center[2][lane]) - double(point.z)};
      const double squared = length_squared(way);
      const Vec3<double> area{normal[0][lane], normal[1][lane], normal[2][lane]};
      return glm::dot(area, way) / (squared * std::sqrt(squared));
    }
  };
  struct Moments {
    Vec3<double> normal{0.0};
    Vec3<double> weighted_center{0.0};
    double area = 0;

    void add(const Moments& other) noexcept {
      normal += other.normal;
      weighted_center += other.weighted_center;
      area += other.area;
    }
  };

  [[nodiscard]] double seen_one_by_one(const Vec3<Scalar>& point, Slots<Index> slots) const {
    double sum = 0;
    bvh_.leaves().for_each_primitive(slots, [&](Index i) {
      sum += double(signed_solid_angle(point, bvh_.set().triangle(i)));
      return Walk::Continue;
    });
    return sum;
  }

  [[nodiscard]] Moments moments_of(Slots<Index> slots) const {
    Moments sum;
    bvh_.leaves().for_each_primitive(slots, [&](Index i) {
      const Triangle<Scalar> t = bvh_.set().triangle(i);
      const Vec3<double> v0(t.v0);
      const Vec3<double> normal = glm::cross(Vec3<double>(t.v1) - v0, Vec3<double>(t.v2) - v0) * 0.5;
      const double area = std::sqrt(length_squared(normal));
      if (area > 0) sum.add({normal, (v0 + Vec3<double>(t.v1) + Vec3<double>(t.v2)) * (area / 3), area});
      return Walk::Continue;
    });
    return sum;
  }

  /// Puts down what is below a node, and returns the sum.
  Moments summarize(Link<Index> link) {
    if (link.is_leaf()) return moments_of(link.slots());
    if (children_.size() <= link.first) children_.resize(std::size_t(link.first) + 1);
    const BoxPack<Scalar, Nodes::width>& boxes = bvh_.nodes().children(link.first);
    const auto& links = bvh_.nodes().links(link.first);
    Children children{};
    Moments sum;
    children.present = lanes_of_boxes(boxes);
    for (std::uint32_t mask = children.present; mask != 0;) {
      const std::size_t i = detail::take_lowest(mask);
      const Moments moments = summarize(links[i]);
      put(children, int(i), moments, detail::box_in_lane(boxes, int(i)));
      sum.add(moments);
    }
    children_[link.first] = children;
    return sum;
  }
  void put(Children& children, int lane, const Moments& moments, const Aabb<Scalar>& box) const {
    const Vec3<Scalar> center = moments.area > 0 ? Vec3<Scalar>(moments.weighted_center / moments.area) : centroid(box);
    for (int axis = 0; axis < 3; ++axis) {
      children.center[std::size_t(axis)].set(lane, component(center, axis));
      children.normal[std::size_t(axis)].set(lane, Scalar(component(moments.normal, axis)));
    }
    const Scalar squared_radius = length_squared(detail::way_past(box, center));
    children.squared_reach.set(lane, accuracy_ * accuracy_ * squared_radius);
  }

  const Bvh<S, L>& bvh_;
  Scalar accuracy_;
  std::vector<Children> children_;  ///< for each inner node
};

/// The distance from a point to the surface, negative where the winding number says that the point is inside. Infinite
/// where there is no surface.
///
/// Requires, Threads: as closest_point and Winding.
template <TriangleSet S, LayoutChoice L>
  requires ClosestPointSet<S>
[[nodiscard]] typename S::Scalar signed_distance(const Winding<S, L>& winding, const Vec3<typename S::Scalar>& point) {
  const auto found = closest_point(winding.bvh(), point);
  if (!found) return infinity<typename S::Scalar>;
  return winding.holds(point) ? -found->distance : found->distance;
}

}  // namespace glint

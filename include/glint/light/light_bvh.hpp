// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/core/index.hpp>
#include <glint/geometry/aabb.hpp>
#include <glint/light/light_bounds.hpp>
#include <glint/light/light_sampler.hpp>
#include <glint/math/constants.hpp>
#include <glint/math/vec.hpp>

namespace glint {

namespace detail {

/// A light that waits for its place in the tree.
struct LightEntry {
  LightBounds bounds{};
  std::uint32_t light = 0;
};

/// How much a group of lights costs those who have to choose in it: its intensity, in how many directions it shines,
/// and how far it spreads. The squared diagonal stands for the area, as importances are those of bounding spheres.
[[nodiscard]] inline float light_group_cost(const LightBounds& group) noexcept {
  const float theta_o = std::acos(std::clamp(group.cos_theta_o, -1.0F, 1.0F));
  const float theta_w = std::min(theta_o + std::acos(group.cos_theta_e), pi<float>);
  const float sin_o = std::sin(theta_o);
  const float directions =
      2 * pi<float> * (1 - group.cos_theta_o) +
      0.5F * pi<float> *
          (2 * theta_w * sin_o - std::cos(theta_o - 2 * theta_w) - 2 * theta_o * sin_o + group.cos_theta_o);
  return group.intensity * directions * length_squared(extent(group.box));
}

/// Where a group of lights is cut in two: along an axis, at one of the borders of equal intervals.
struct LightSplit {
  static constexpr int intervals = 12;

  int axis = -1;  ///< −1: no cut separates the lights
  int border = 0;
  float cost = infinity<float>;

  [[nodiscard]] static int interval(const LightEntry& entry, const Aabb<float>& centers, int axis) noexcept {
    const float lower = component(centers.lower, axis);
    const float share =
        (component(centroid(entry.bounds.box), axis) - lower) / (component(centers.upper, axis) - lower);
    return std::clamp(static_cast<int>(share * intervals), 0, intervals - 1);
  }

  /// Tries the borders across one axis. Thin slices are made costly in proportion.
  void try_axis(std::span<const LightEntry> entries, const Aabb<float>& centers, int along) noexcept {
    std::array<LightBounds, intervals> groups{};
    for (const LightEntry& entry : entries) {
      LightBounds& group = groups[static_cast<std::size_t>(interval(entry, centers, along))];
      group = join(group, entry.bounds);
    }
    std::array<float, intervals> above{};
    LightBounds sum;
    for (std::size_t i = intervals - 1; i > 0; --i) {
      sum = join(sum, groups[i]);
      above[i] = sum.intensity > 0 ? light_group_cost(sum) : infinity<float>;
    }
    const Vec3<float> size = extent(centers);
    const float thinness = max_component(size) / component(size, along);
    sum = {};
    for (std::size_t i = 1; i < intervals; ++i) {
      sum = join(sum, groups[i - 1]);
      if (!(sum.intensity > 0)) continue;
      const float candidate = thinness * (light_group_cost(sum) + above[i]);
      if (candidate < cost) *this = {along, static_cast<int>(i), candidate};
    }
  }
};

}  // namespace detail

/// Chooses among any number of lights by a tree of them: from the root down, at each node one of two groups, in
/// proportion to a bound on the light that reaches the surface from there. Lights without bounds, those at infinity,
/// are chosen apart, each as often as all the tree.
///
/// Requires: fewer than 2³⁰ lights.
/// Cost:     logarithmic in the number of lights; about 120 bytes a light.
/// Source:   Conty Estevez, Kulla, "Importance Sampling of Many Lights with Adaptive Tree Splitting", HPG 2018; Pharr,
///           Jakob, Humphreys, Physically Based Rendering (2023), section 12.6.3. Importances are those of bounding
///           spheres, not boxes; and distances count down to √⅛ of their radius, not to all of it or more: near a
///           group, its lights give much more than they would all together from its rim (variance falls to a quarter).
class LightBvh {
 public:
  LightBvh() = default;

  template <Light L>
  LightBvh(std::span<const L> lights, const Aabb<float>& /*scene*/) : places_(lights.size(), nowhere) {
    std::vector<detail::LightEntry> entries;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      const std::optional<LightBounds> found = light_bounds(lights[i]);
      if (!found || !is_finite(extent(found->box))) {
        places_[i] = apart;
        apart_.push_back(i);
      } else if (found->intensity > 0 && found->intensity < infinity<float>) {
        entries.push_back({*found, i});
      }
    }
    if (!entries.empty()) {
      nodes_.reserve(2 * entries.size() - 1);
      nodes_.emplace_back();
      build(0, entries, 0, 0);
    }
    const std::size_t choices = apart_.size() + (nodes_.empty() ? 0 : 1);
    share_ = choices > 0 ? 1 / static_cast<float>(choices) : 0;
    tree_share_ = nodes_.empty() ? 0 : share_;
  }

  [[nodiscard]] std::optional<ChosenLight> choose(const Vec3<float>& from, const Vec3<float>& normal,
                                                  float u) const noexcept {
    if (!apart_.empty() && !(u < tree_share_)) {
      const auto i = static_cast<std::size_t>((u - tree_share_) / share_);
      return ChosenLight{apart_[std::min(i, apart_.size() - 1)], share_};
    }
    if (nodes_.empty()) return std::nullopt;
    float probability = tree_share_;
    std::uint32_t node = 0;
    u /= tree_share_;
    while (!nodes_[node].is_leaf()) {
      const std::uint32_t child = nodes_[node].child;
      const float first = importance(nodes_[child], from, normal);
      const float total = first + importance(nodes_[child + 1], from, normal);
      if (!(total > 0)) return std::nullopt;
      const float share = first / total;
      const bool left = u < share;
      const float chance = left ? share : 1 - share;
      u = std::min((left ? u : u - share) / chance, one_minus_epsilon<float>);
      probability *= chance;
      node = left ? child : child + 1;
    }
    return ChosenLight{nodes_[node].light, probability};
  }

  [[nodiscard]] float probability(const Vec3<float>& from, const Vec3<float>& normal,
                                  std::uint32_t light) const noexcept {
    std::uint32_t turns = places_[light];
    if (turns == apart) return share_;
    if (turns == nowhere) return 0;
    float probability = tree_share_;
    for (std::uint32_t node = 0; !nodes_[node].is_leaf(); turns >>= 1) {
      const std::uint32_t child = nodes_[node].child;
      const float first = importance(nodes_[child], from, normal);
      const float total = first + importance(nodes_[child + 1], from, normal);
      if (!(total > 0)) return 0;
      const float share = first / total;
      const bool left = (turns & 1U) == 0;
      probability *= left ? share : 1 - share;
      node = left ? child : child + 1;
    }
    return probability;
  }

 private:
  /// What a descent needs of a group: its bounding sphere and where it shines to. Children are neighbors.
  struct Node {
    Vec3<float> center{0.0F};
    float radius_squared = 0;
    Vec3<float> axis{0.0F, 0.0F, 1.0F};
    float intensity = 0;
    float cos_o = -1;
    float sin_o = 0;
    float cos_e = 0;
    std::uint32_t child = none<std::uint32_t>;
    std::uint32_t light = none<std::uint32_t>;

    [[nodiscard]] bool is_leaf() const noexcept { return light != none<std::uint32_t>; }
  };

  /// An angle in [0, π], by cosine and sine.
  struct Angle {
    float cos = 1;
    float sin = 0;

    /// What is left of it without the other; nothing is less than zero.
    [[nodiscard]] Angle less(const Angle& other) const noexcept {
      if (cos >= other.cos) return {1, 0};
      return {cos * other.cos + sin * other.sin, sin * other.cos - cos * other.sin};
    }
  };
  [[nodiscard]] static Angle angle(float cosine) noexcept {
    return {cosine, std::sqrt(std::max(0.0F, 1 - cosine * cosine))};
  }

  /// A bound on the light that a group brings to a surface, but for constants: intensity · cosine at the light · cosine
  /// at the surface / distance², with the angles that are best among all points of the bounding sphere.
  [[nodiscard]] static float importance(const Node& node, const Vec3<float>& from, const Vec3<float>& normal) noexcept {
    const Vec3<float> to = node.center - from;
    const float squared = std::max(length_squared(to), 1e-30F);
    const float inverse = 1 / std::sqrt(squared);
    const float sin_squared = node.radius_squared / squared;
    const bool outside = sin_squared < 1;
    const Angle width = outside ? Angle{std::sqrt(1 - sin_squared), std::sqrt(sin_squared)} : Angle{-1, 0};
    const Angle off_axis = angle(-glm::dot(node.axis, to) * inverse).less({node.cos_o, node.sin_o}).less(width);
    if (!(off_axis.cos > node.cos_e)) return 0;
    const float bound = node.intensity * off_axis.cos / std::max(squared, node.radius_squared * 0.125F);
    if (normal == Vec3<float>(0)) return bound;
    return bound * angle(std::min(std::abs(glm::dot(normal, to)) * inverse, 1.0F)).less(width).cos;
  }

  /// Puts a group into a node, and its two halves, if it has any, into the two nodes after the last.
  void build(std::uint32_t index, std::span<detail::LightEntry> group, std::uint32_t turns, int depth) {
    LightBounds all;
    for (const detail::LightEntry& entry : group) all = join(all, entry.bounds);
    Node node{.center = centroid(all.box),
              .radius_squared = 0.25F * length_squared(extent(all.box)),
              .axis = all.axis,
              .intensity = all.intensity,
              .cos_o = all.cos_theta_o,
              .sin_o = angle(all.cos_theta_o).sin,
              .cos_e = all.cos_theta_e};
    if (group.size() == 1) {
      node.light = group[0].light;
      places_[node.light] = turns;
      nodes_[index] = node;
      return;
    }
    node.child = static_cast<std::uint32_t>(nodes_.size());
    nodes_[index] = node;
    nodes_.resize(nodes_.size() + 2);
    const std::size_t half = split(group, depth);
    build(node.child, group.first(half), turns, depth + 1);
    build(node.child + 1, group.subspan(half), turns | 1U << static_cast<unsigned>(depth), depth + 1);
  }

  /// Sorts a group into two and returns the size of the first: by the cheapest cut, but by halves where no cut
  /// separates it or the turns to the last of its lights would not fit into 30 bits.
  [[nodiscard]] static std::size_t split(std::span<detail::LightEntry> group, int depth) {
    Aabb<float> centers;
    for (const detail::LightEntry& entry : group) extend(centers, centroid(entry.bounds.box));
    detail::LightSplit best;
    if (depth + static_cast<int>(std::bit_width(group.size() - 1)) < 30) {
      for (int axis = 0; axis < 3; ++axis) {
        if (component(extent(centers), axis) > 0) best.try_axis(group, centers, axis);
      }
    }
    if (best.axis < 0) return group.size() / 2;
    const auto middle = std::partition(group.begin(), group.end(), [&](const detail::LightEntry& entry) {
      return detail::LightSplit::interval(entry, centers, best.axis) < best.border;
    });
    const auto half = static_cast<std::size_t>(middle - group.begin());
    return half > 0 && half < group.size() ? half : group.size() / 2;  // rounding may move a light over a border
  }

  static constexpr std::uint32_t nowhere = none<std::uint32_t>;  ///< never chosen, for it gives no light
  static constexpr std::uint32_t apart = nowhere - 1;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> places_;  ///< of each light: the turns that lead to it, the first in the lowest bit
  std::vector<std::uint32_t> apart_;
  float share_ = 0;  ///< of each light apart, and of the tree
  float tree_share_ = 0;
};

static_assert(LightSampler<LightBvh>);

}  // namespace glint

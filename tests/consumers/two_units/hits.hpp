// SPDX-License-Identifier: MIT
#pragma once
#include <optional>
#include <vector>

#include "every_header.hpp"

/// The grid of spheres that a grid of rays hits, traced by this unit's own code, one by one and in a batch. Each of
/// 20 × 20 rays meets one.
static int hits_in_this_unit() {
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 400; ++i) spheres.push_back({.center = {i % 20, i / 20, i % 7}, .radius = 0.4F});
  const glint::Bvh bvh{glint::Elements{spheres}};
  std::vector<glint::Ray<float>> rays;
  for (int i = 0; i < 400; ++i) {
    rays.push_back({.origin = {i % 20, i / 20, 9}, .direction = {0.001F, 0.001F, -1}});  // of one course: a packet
  }
  std::vector<std::optional<glint::Hit<float>>> batch(rays.size());
  bvh.closest(rays, batch);
  int hits = 0;
  for (unsigned i = 0; i < 400; ++i) {
    const auto hit = bvh.closest(rays[i]);
    hits += int(hit && hit->primitive == i && hit == batch[i] && bvh.occluded(rays[i]));
  }
  return hits;
}

// SPDX-License-Identifier: MIT
#pragma once
#include <vector>

#include "every_header.hpp"

/// The grid of spheres that a grid of rays hits, traced by this unit's own code. Each of 20 × 20 rays meets one.
static int hits_in_this_unit() {
  std::vector<glint::Sphere<float>> spheres;
  for (int i = 0; i < 400; ++i) spheres.push_back({.center = {i % 20, i / 20, i % 7}, .radius = 0.4F});
  const glint::Bvh bvh{glint::Elements{spheres}};
  int hits = 0;
  for (unsigned i = 0; i < 400; ++i) {
    const glint::Ray<float> ray{.origin = {i % 20, i / 20, 9}, .direction = {0, 0, -1}};
    const auto hit = bvh.closest(ray);
    hits += int(hit && hit->primitive == i && bvh.occluded(ray));
  }
  return hits;
}

// SPDX-License-Identifier: MIT
// A thousand stones of two kinds on a field: each kind is in memory once. A tree over the stones is the upper of two
// levels; when stones roll, it is refitted, and the trees of the stones stay as they are.
#include <cstddef>
#include <cstdio>
#include <vector>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/math/affine.hpp>
#include <glint/math/random.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

// <region: place>
using Stone = glint::Bvh<glint::TriangleMesh<float>>;
using Placement = glint::Affine<float>;

/// Where the stones lie after they have turned by an angle.
std::vector<glint::Instance<Stone>> field(const Stone& round, const Stone& rough, float angle) {
  glint::Random random(1);
  std::vector<glint::Instance<Stone>> stones;
  for (int i = 0; i < 1000; ++i) {
    const int row = i / 40;
    const glm::vec3 spot{float(i % 40) - 20, 0, float(row) - 12};
    const glm::vec3 size = glm::vec3(0.2F) + random.uniform_vec3<float>() * 0.2F;
    stones.push_back(
        place(i % 3 == 0 ? rough : round,
              Placement::translate(spot) * Placement::rotate({1, 0, 1}, angle + float(i)) * Placement::scale(size)));
  }
  return stones;
}
// </region: place>

std::size_t count_hits(const auto& world) {
  std::size_t hits = 0;
  for (int pixel = 0; pixel < 128 * 128; ++pixel) {
    const int row = pixel / 128;
    const int column = pixel % 128;
    const glint::Ray<float> ray{.origin = {0, 20, 20}, .direction = {float(column) / 64 - 1, float(row) / 64 - 2, -1}};
    hits += std::size_t(world.closest(ray).has_value());
  }
  return hits;
}

}  // namespace

int main() {
  const auto blob = glint::testing::scanned_blob<float>(5000, 1);
  const auto splinters = glint::testing::triangle_soup<float>(2000, 2);
  const Stone round(view(blob));
  const Stone rough(view(splinters));

  // <region: trace>
  auto stones = field(round, rough, 0);
  glint::Bvh world{glint::Instanced{stones}};

  const glint::Ray<float> down{.origin = {0, 9, 0}, .direction = {0, -1, 0}};
  if (const auto hit = world.closest(down)) {
    const auto normal = world.surface(down, *hit).normal;
    std::printf("stone %u, triangle %u, normal %.2f %.2f %.2f\n", hit->primitive, hit->inner, double(normal.x),
                double(normal.y), double(normal.z));
  }

  stones = field(round, rough, 0.5F);
  world.refit(glint::Instanced{stones});
  // </region: trace>

  const std::size_t hits = count_hits(world);
  std::printf("%zu of 16384 rays hit one of %zu stones\n", hits, stones.size());
  return hits == count_hits(glint::Bvh{glint::Instanced{stones}}) && hits > 0 ? 0 : 1;
}

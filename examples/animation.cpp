// SPDX-License-Identifier: MIT
// A mesh that is twisted a little more in each frame: its tree follows, and is built anew where that got too costly.
// Each frame is compared with a tree built for it alone.
#include <cmath>
#include <cstdio>
#include <vector>

#include <glm/vec3.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/core/tbb_executor.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/testing/random_scenes.hpp>

namespace {

/// Turned about the y axis, the further the higher up.
std::vector<glm::vec3> twisted(const std::vector<glm::vec3>& rest, float angle_per_height) {
  std::vector<glm::vec3> positions;
  for (const glm::vec3& p : rest) {
    const float c = std::cos(angle_per_height * p.y);
    const float s = std::sin(angle_per_height * p.y);
    positions.emplace_back(c * p.x - s * p.z, p.y, s * p.x + c * p.z);
  }
  return positions;
}

/// The depths that a small camera sees; infinity where it sees nothing.
std::vector<float> depths(const auto& bvh) {
  std::vector<float> depths;
  for (int pixel = 0; pixel < 64 * 64; ++pixel) {
    const int row = pixel / 64;
    const int column = pixel % 64;
    const glint::Ray<float> ray{.origin = {0, 0, 4},
                                .direction = {float(column) / 64 - 0.5F, float(row) / 64 - 0.5F, -1}};
    const auto hit = bvh.closest(ray);
    depths.push_back(hit ? hit->t : ray.t_max);
  }
  return depths;
}

}  // namespace

int main() {
  const glint::TbbExecutor threads;
  auto mesh = glint::testing::scanned_blob<float>(20000, 1);
  const std::vector<glm::vec3> rest = mesh.positions;
  const auto built = [&] { return glint::Bvh(view(mesh), glint::BinnedSah{}, threads); };
  auto bvh = built();

  int rebuilds = 0;
  for (int frame = 1; frame <= 24; ++frame) {
    mesh.positions = twisted(rest, 0.25F * float(frame));
    const glint::Refit refit = bvh.refit(view(mesh), threads);
    if (refit.growth > 1.5) {
      bvh = built();
      ++rebuilds;
    }
    std::printf("frame %2d: growth %.2f%s\n", frame, refit.growth, refit.growth > 1.5 ? ", built anew" : "");
    if (depths(bvh) != depths(built())) return 1;
  }
  return rebuilds > 0 ? 0 : 1;
}

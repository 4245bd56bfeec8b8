// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>

#include <glint/bvh/build/binned_sah.hpp>
#include <glint/bvh/pass/statistics.hpp>
#include <glint/color/rgb.hpp>
#include <glint/geometry/triangle_mesh.hpp>
#include <glint/io/image.hpp>
#include <glint/io/mesh_obj.hpp>
#include <glint/io/scene_file.hpp>

#include "commands.hpp"
#include "read_scene.hpp"

namespace {

void tell_box(const glint::Aabb<float>& box) {
  if (glint::is_empty(box)) {
    std::printf("%-14s empty\n", "bounds");
    return;
  }
  std::printf("%-14s (%g, %g, %g) to (%g, %g, %g)\n", "bounds", static_cast<double>(box.lower.x),
              static_cast<double>(box.lower.y), static_cast<double>(box.lower.z), static_cast<double>(box.upper.x),
              static_cast<double>(box.upper.y), static_cast<double>(box.upper.z));
}

void tell_tree(const glint::TreeStatistics& tree) {
  std::printf("%-14s %zu nodes, %zu leaves, depth %d, SAH cost %.2f\n", "tree", tree.nodes, tree.leaves, tree.depth,
              tree.sah_cost);
}

void tell_image(const std::filesystem::path& path) {
  const glint::Image image = glint::read_image(path);
  glint::Rgb lowest{glint::infinity<float>};
  glint::Rgb highest{-glint::infinity<float>};
  double sum[3] = {};
  std::uint64_t broken = 0;
  for (const glint::Rgb& c : image.pixels()) {
    if (!glint::is_finite(c)) {
      ++broken;
      continue;
    }
    lowest = {std::min(lowest.r, c.r), std::min(lowest.g, c.g), std::min(lowest.b, c.b)};
    highest = {std::max(highest.r, c.r), std::max(highest.g, c.g), std::max(highest.b, c.b)};
    sum[0] += static_cast<double>(c.r);
    sum[1] += static_cast<double>(c.g);
    sum[2] += static_cast<double>(c.b);
  }
  const double n = static_cast<double>(std::max<std::uint64_t>(1, image.pixels().size() - broken));
  std::printf("%-14s %dx%d pixels\n", "image", image.width(), image.height());
  std::printf("%-14s %.6g %.6g %.6g\n", "mean", sum[0] / n, sum[1] / n, sum[2] / n);
  std::printf("%-14s %g %g %g\n", "lowest", static_cast<double>(lowest.r), static_cast<double>(lowest.g),
              static_cast<double>(lowest.b));
  std::printf("%-14s %g %g %g\n", "highest", static_cast<double>(highest.r), static_cast<double>(highest.g),
              static_cast<double>(highest.b));
  if (broken != 0) std::printf("%-14s %llu pixels\n", "not finite", static_cast<unsigned long long>(broken));
}

void tell_mesh(const std::filesystem::path& path) {
  const glint::ObjMesh obj = glint::read_obj(path);
  for (const std::string& warning : obj.warnings) std::fprintf(stderr, "glint: warning: %s\n", warning.c_str());
  const auto mesh = glint::view(obj.buffers);
  std::printf("%-14s %zu triangles, %zu vertices%s%s, %zu materials\n", "mesh", obj.buffers.indices.size() / 3,
              obj.buffers.positions.size(), obj.buffers.normals.empty() ? "" : ", normals",
              obj.buffers.uvs.empty() ? "" : ", texture coordinates", obj.materials.size());
  const auto tree = glint::BinnedSah{}.build(mesh);
  tell_box(tree.nodes.empty() ? glint::Aabb<float>{} : tree.nodes.front().bounds);
  tell_tree(glint::statistics(tree));
  if (tree.left_out != 0) std::printf("%-14s %zu triangles without a finite box\n", "left out", tree.left_out);
}

void tell_scene(const std::filesystem::path& path) {
  const glint::SceneFile scene = read_scene({.path = path});
  std::printf("%-14s %zu triangles, %zu spheres, %zu disks, %zu rectangles\n", "scene", scene.triangle_count(),
              scene.spheres.size(), scene.disks.size(), scene.quads.size());
  std::printf("%-14s %zu\n%-14s %zu\n", "materials", scene.materials.size(), "lights", scene.lights.size());
  std::printf("%-14s %dx%d, %d samples a pixel\n", "film", scene.film.resolution.x, scene.film.resolution.y,
              scene.integrator.samples);
  const auto tree = glint::BinnedSah{}.build(scene.shapes());
  tell_box(tree.nodes.empty() ? glint::Aabb<float>{} : tree.nodes.front().bounds);
  tell_tree(glint::statistics(tree));
  for (const std::filesystem::path& input : scene.inputs) std::printf("%-14s %s\n", "reads", input.string().c_str());
}

}  // namespace

int tell_of_file(const std::filesystem::path& path) {
  static constexpr std::array<std::string_view, 7> images{".exr", ".hdr", ".png", ".jpg", ".jpeg", ".bmp", ".tga"};
  const std::string extension = glint::detail::lower_case_extension(path);
  if (extension == ".json") {
    tell_scene(path);
  } else if (extension == ".obj") {
    tell_mesh(path);
  } else if (std::find(images.begin(), images.end(), extension) != images.end()) {
    tell_image(path);
  } else {
    throw glint::IoError(path, "is of no known kind: expected .json, .obj or an image");
  }
  return 0;
}

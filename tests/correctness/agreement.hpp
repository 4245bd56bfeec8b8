// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/microfacet.hpp>
#include <glint/bsdf/rough_conductor.hpp>
#include <glint/camera/perspective.hpp>
#include <glint/color/image.hpp>
#include <glint/core/one_of.hpp>
#include <glint/film/film.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/light_tracer.hpp>
#include <glint/integrator/path.hpp>
#include <glint/material/material_table.hpp>
#include <glint/render/render.hpp>

#include <correctness/rows.hpp>
#include <integrator/rooms.hpp>

/// Boxes of which nobody knows the radiance, and whether all integrators find the same.
namespace correctness {

using namespace glint;

using BoxMaterial = OneOf<Lambertian, RoughConductor<Ggx>, Dielectric>;

/// A colored room with a lamp under its ceiling and a ball in the middle.
struct Box {
  std::vector<Quad<float>> walls = room_walls();
  std::vector<Sphere<float>> balls{{.center = {0.1F, -0.5F, -0.2F}, .radius = 0.45F}};

  [[nodiscard]] auto scene(const BoxMaterial& ball, const BoxMaterial& back_wall) {
    walls.resize(6);
    walls.push_back({{-0.4F, 0.95F, -0.4F}, {0.8F, 0, 0}, {0, 0, 0.8F}});  // faces down
    const Lambertian gray{Rgb{0.7F}};
    const MaterialTable<BoxMaterial> materials{
        {gray, Lambertian{Rgb{0.6F, 0.1F, 0.1F}}, Lambertian{Rgb{0.1F, 0.5F, 0.1F}}, Lambertian{Rgb{0.0F}}, ball,
         back_wall},
        {5, 0, 1, 2, 0, 0, 3, 4}};
    Lights<AreaLight<Quad<float>>> lights{{{walls.back(), Rgb{8}}}, std::vector(8, none<std::uint32_t>)};
    lights.of_primitive[6] = 0;
    return Scene{Bvh{Joined{Elements{walls}, Elements{balls}}}, materials, lights};
  }
};

/// The mean of a small picture's green, and its standard error from independent renderings.
template <typename S, typename I>
[[nodiscard]] Estimate picture_mean(const S& scene, const I& integrator, std::uint64_t seed, int samples) {
  constexpr int renderings = 32;
  const Perspective camera{.eye = {0, 0, 0.95F}, .target = {0, -0.2F, -1}, .fov_y_radians = 1.2F};
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < renderings; ++i) {
    Film film{{16, 16}};
    (void)render(scene, camera, integrator, film, {.samples = samples}, Serial{},
                 Independent{.seed = seed + std::uint64_t(i)});
    double mean = 0;
    const Image image = film.develop();
    for (const Rgb& pixel : image.pixels()) mean += double(pixel.g) / 256;
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / renderings;
  return {mean, std::sqrt(std::max(0.0, squares / renderings - mean * mean) / (renderings - 1))};
}

/// Whether a box has anything that is seen through a specular surface, which no path from a light can show a pinhole.
enum class SeenThroughGlass { No, Yes };

/// Rows that compare each integrator with the walk that finds light by chance, which has hardly anything to get wrong.
template <typename S>
void add_agreement(std::vector<Row>& rows, const std::string& box, const S& scene, int samples,
                   SeenThroughGlass glass = SeenThroughGlass::No) {
  for (const int depth : {3, 8}) {
    const auto path = [&](LightStrategy strategy) {
      return Path{.max_depth = depth, .roulette_below = 0.1F, .strategy = strategy};
    };
    const Estimate walk = picture_mean(scene, path(LightStrategy::RandomWalk), 1000, 8 * samples);
    const auto add = [&](const std::string& name, const Estimate& estimate) {
      rows.push_back({box + ", " + std::to_string(depth) + " segments, " + name, walk.mean, estimate, walk.error});
    };
    add("path, MIS", picture_mean(scene, path(LightStrategy::Mis), 2000, samples));
    add("path, next event", picture_mean(scene, path(LightStrategy::NextEvent), 3000, samples));
    if (glass == SeenThroughGlass::No) {
      const LightTracer tracer{.max_depth = depth};
      add("light tracer", picture_mean(scene, tracer, 4000, samples));
    }
  }
}

[[nodiscard]] inline std::vector<Row> agreement(int samples) {
  std::vector<Row> rows;
  const Lambertian gray{Rgb{0.7F}};
  const RoughConductor<Ggx> metal{.distribution = {0.25F, 0.25F}, .eta = Rgb{1.2F}, .k = Rgb{4}};
  Box box;
  add_agreement(rows, "diffuse box", box.scene(gray, gray), samples);
  add_agreement(rows, "glossy box", box.scene(metal, metal), samples);
  add_agreement(rows, "box with a glass ball", box.scene(Dielectric{}, gray), samples, SeenThroughGlass::Yes);
  return rows;
}

}  // namespace correctness

// SPDX-License-Identifier: MIT
#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/color/image.hpp>
#include <glint/geometry/disk.hpp>
#include <glint/geometry/set/filtered.hpp>
#include <glint/geometry/set/joined.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/integrator/path.hpp>
#include <glint/light/environment.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/opacity.hpp>
#include <glint/texture/constant.hpp>
#include <glint/texture/image_texture.hpp>

#include <correctness/rows.hpp>
#include <integrator/rooms.hpp>

/// Radiances that can be written down, and what paths find.
namespace correctness {

using namespace glint;

inline constexpr std::array<std::pair<const char*, LightStrategy>, 3> strategies{
    {{"MIS", LightStrategy::Mis}, {"next event", LightStrategy::NextEvent}, {"by chance", LightStrategy::RandomWalk}}};

/// A row for each strategy.
template <typename S>
void add(std::vector<Row>& rows, const std::string& what, double expected, const S& scene, const Ray<float>& ray,
         int depth, int samples) {
  for (const auto& [name, strategy] : strategies) {
    const Path path{.max_depth = depth, .roulette_below = depth > 50 ? 0.5F : 0.0F, .strategy = strategy};
    rows.push_back({what + ", " + name, expected, estimate(path, scene, ray, samples)});
  }
}

/// A room of walls that shine: 1 + ρ + ρ² + …
inline void add_furnaces(std::vector<Row>& rows, int samples) {
  const Furnace furnace;
  const auto scene = furnace.scene(0.5F);
  const Ray<float> ray{.direction = {0.3F, 0.5F, -0.8F}};
  for (const int depth : {1, 2, 5, 1000}) {
    const std::string name = depth == 1000 ? "∞" : std::to_string(depth);
    add(rows, "furnace, reflectance ½, " + name + " segments", 2 * (1 - std::pow(0.5, depth)), scene, ray, depth,
        samples);
  }
}

/// What a point at the origin that faces +z receives from a polygon of radiance one (Lambert 1760): half the sum over
/// the edges of the angle that one subtends, times the cosine of its plane's normal.
[[nodiscard]] inline double polygon_irradiance(const std::array<Vec3<double>, 4>& corners) {
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3<double> a = glm::normalize(corners[i]);
    const Vec3<double> b = glm::normalize(corners[(i + 1) % 4]);
    sum += 0.5 * std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b)).z;
  }
  return std::abs(sum);
}

/// A large white floor in z = 0, looked at from above in the middle, under one shape that shines with radiance one.
template <typename Shape>
void add_floor(std::vector<Row>& rows, const std::string& what, double irradiance, const Shape& lamp, int samples) {
  const std::vector<Quad<float>> floor{{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}};
  const std::vector<Shape> lamps{lamp};
  const MaterialTable<Lambertian> materials{{Lambertian{Rgb{0.8F}}, Lambertian{Rgb{0.0F}}}, {0, 1}};
  const Lights<AreaLight<Shape>> lights{{AreaLight<Shape>{lamp, Rgb{1}}}, {none<std::uint32_t>, 0}};
  const Scene scene{Bvh{Joined{Elements{floor}, Elements{lamps}}}, materials, lights};
  const Ray<float> ray{.origin = {0.3F, 0, 0.3F}, .direction = {-0.3F, 0, -0.3F}};
  add(rows, what, 0.8 / pi<double> * irradiance, scene, ray, 2, samples);
}

inline void add_lamps(std::vector<Row>& rows, int samples) {
  const Quad<float> quad{.origin = {-0.5F, 0.25F, 1.5F}, .edge_u = {0, 2, 0.5F}, .edge_v = {1, 0.5F, 0}};
  const auto corner = [&](float u, float v) { return Vec3<double>(quad.origin + quad.edge_u * u + quad.edge_v * v); };
  add_floor(rows, "rectangle, by Lambert's formula for polygons",
            polygon_irradiance({corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)}), quad, samples);
  // π (r/d)² cos θ, all of it above the horizon: d² = 29, cos θ = 5 / d
  add_floor(rows, "sphere, π (r/d)² cos θ", pi<double> * 4 / 29 * 5 / std::sqrt(29.0),
            Sphere<float>{.center = {2, 0, 5}, .radius = 2}, samples);
  // π sin² of the angular radius
  add_floor(rows, "disk overhead, π sin²", pi<double> * 0.36,
            Disk<float>{.center = {0, 0, 2}, .normal = {0, 0, -1}, .radius = 1.5F}, samples);
}

/// That floor below the rectangle, with a black curtain between them that stops 0.4 of the light.
inline void add_gauze(std::vector<Row>& rows, int samples) {
  const std::vector<Quad<float>> quads{{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}},
                                       {{-50, -50, 1}, {100, 0, 0}, {0, 100, 0}},
                                       {{-1, -1, 2}, {0, 2, 0}, {2, 0, 0}}};
  const std::vector<ConstantTexture> opacities{{Rgb{0.4F}}};
  const std::vector<std::uint32_t> of_primitive{none<std::uint32_t>, 0, none<std::uint32_t>};
  const Elements set{quads};
  const Opacity opacity{set, std::span(opacities), std::span(of_primitive)};
  const MaterialTable<Lambertian> materials{{Lambertian{Rgb{0.8F}}, Lambertian{Rgb{0.0F}}}, {0, 1, 1}};
  const Lights<AreaLight<Quad<float>>> lights{{AreaLight<Quad<float>>{quads[2], Rgb{1}}},
                                              {none<std::uint32_t>, none<std::uint32_t>, 0}};
  const Scene scene{Bvh{Filtered{set, opacity}}, materials, lights};
  const Ray<float> ray{.origin = {0.3F, 0, 0.3F}, .direction = {-0.3F, 0, -0.3F}};
  const double irradiance = polygon_irradiance({Vec3<double>{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}});
  add(rows, "rectangle behind gauze of opacity 0.4", 0.6 * 0.8 / pi<double> * irradiance, scene, ray, 2, samples);
}

/// The mean over a disk of what arrives from another one, parallel and on one axis, at distance 1: F = (S − √(S² −
/// 4 (r₂/r₁)²)) / 2 with S = 1 + (1 + r₂²) / r₁² (Howell, Mengüç, Siegel, "Thermal Radiation Heat Transfer", C-41).
inline void add_disks(std::vector<Row>& rows, int samples) {
  constexpr float r1 = 0.8F;
  constexpr float r2 = 1.2F;
  const std::vector<Disk<float>> disks{{.center = {0, 0, 0}, .normal = {0, 0, 1}, .radius = r1},
                                       {.center = {0, 0, 1}, .normal = {0, 0, -1}, .radius = r2}};
  const MaterialTable<Lambertian> materials{{Lambertian{Rgb{1}}, Lambertian{Rgb{0.0F}}}, {0, 1}};
  const Lights<AreaLight<Disk<float>>> lights{{AreaLight<Disk<float>>{disks[1], Rgb{1}}}, {none<std::uint32_t>, 0}};
  const Scene scene{Bvh{Elements{disks}}, materials, lights};
  const double s = 1 + (1 + double(r2) * double(r2)) / (double(r1) * double(r1));
  const double expected = 0.5 * (s - std::sqrt(s * s - 4 * double(r2) * double(r2) / (double(r1) * double(r1))));
  for (const auto& [name, strategy] : strategies) {
    const Path path{.max_depth = 2, .strategy = strategy};
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < samples; ++i) {
      auto sampler = Independent{.seed = 5}.stream({0, 0}, i);
      const Vec2<float> at = concentric_disk(sampler.next_2d()) * r1;
      const Ray<float> ray{.origin = {at.x, at.y, 0.5F}, .direction = {0, 0, -1}};
      const auto value = double(path.radiance(scene, ray, sampler).g);
      sum += value;
      squares += value * value;
    }
    const double mean = sum / samples;
    rows.push_back({std::string("parallel disks, form factor, ") + name,
                    expected,
                    {mean, std::sqrt(std::max(0.0, squares / samples - mean * mean) / samples)}});
  }
}

/// A floor under an environment, without and with a texture of which one pixel shines.
inline void add_environments(std::vector<Row>& rows, int samples) {
  const std::vector<Quad<float>> floor{{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}};  // faces +y
  const Ray<float> ray{.origin = {0, 1, 0}, .direction = {0.1F, -1, 0}};
  const Scene constant{Bvh{Elements{floor}}, Lambertian{Rgb{0.8F}}, ConstantEnvironment{Rgb{2}}};
  add(rows, "floor under an even sky", 1.6, constant, ray, 2, samples);

  // Pixel (5, 2) of 16 × 8: θ from 2π/8 to 3π/8, φ over 2π/16; ∫ cos θ sin θ dθ dφ = π/16 (sin² θ₁ − sin² θ₀).
  const auto image = std::make_shared<Image>(Vec2i{16, 8});
  (*image)(5, 2) = Rgb{100};
  const ImageTexture texture{.image = image, .interpolation = Interpolation::Nearest};
  const double sines = std::pow(std::sin(3 * pi<double> / 8), 2) - std::pow(std::sin(2 * pi<double> / 8), 2);
  const double expected = 0.8 / pi<double> * 100 * pi<double> / 16 * sines;
  const Scene single{Bvh{Elements{floor}}, Lambertian{Rgb{0.8F}},
                     EnvironmentLight<ImageTexture>{texture, Vec2i{16, 8}}};
  add(rows, "floor under a sky of one bright pixel", expected, single, ray, 2, samples);

  const std::vector<Sphere<float>> ball{{.center = {0, 0, -4}}};
  const Scene glass{Bvh{Elements{ball}}, Dielectric{}, ConstantEnvironment{Rgb{1}}};
  const Path path{.max_depth = 1000, .roulette_below = 0.5F};
  rows.push_back({"clear glass ball under an even sky", 1,
                  estimate(path, glass, Ray<float>{.direction = {0.12F, 0.1F, -1}}, samples)});
}

[[nodiscard]] inline std::vector<Row> closed_forms(int samples) {
  std::vector<Row> rows;
  add_furnaces(rows, samples);
  add_lamps(rows, samples);
  add_gauze(rows, samples);
  add_disks(rows, samples);
  add_environments(rows, samples);
  return rows;
}

}  // namespace correctness

// SPDX-License-Identifier: MIT
#include <glint/integrator/aov.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>

#include <support/catch.hpp>

#include <glint/bsdf/dielectric.hpp>
#include <glint/bsdf/lambertian.hpp>
#include <glint/bsdf/mirror.hpp>
#include <glint/bvh/bvh.hpp>
#include <glint/core/one_of.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/set/instanced.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/material/material_table.hpp>
#include <glint/math/affine.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/scene.hpp>

namespace test_integrator_aov {

namespace aov = glint::aov;
using glint::none;
using glint::Ray;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;

namespace {

using Surface = glint::OneOf<glint::Lambertian, glint::Mirror, glint::Dielectric>;

const Rgb red{0.8F, 0.2F, 0.1F};
const Rgb tint{0.9F, 0.8F, 0.5F};

/// A red wall in the plane z = 0, and a mirror in the plane z = 5 that faces it.
struct Hall {
  std::vector<glint::Quad<float>> walls{{{-4, -2, 0}, {8, 0, 0}, {0, 4, 0}}, {{-4, -2, 5}, {0, 4, 0}, {8, 0, 0}}};
  glint::Scene<glint::Bvh<glint::Elements<glint::Quad<float>>>, glint::MaterialTable<Surface>> scene{
      glint::Bvh{glint::Elements{walls}}, {{glint::Lambertian{red}, glint::Mirror{tint}}, {0, 1}}};
};

/// What a variable says of a ray.
template <typename A, typename S>
auto seen(const A& variable, const S& scene, const Ray<float>& ray, int sample = 0) {
  static_assert(glint::SurfaceAovFor<A, S, glint::IndependentSampler>);
  return variable.at_surface(scene, ray, scene.interact(ray), glint::Independent{.seed = 1}.stream({0, 0}, sample));
}
template <typename A, typename S>
std::uint32_t id(const A& variable, const S& scene, const Ray<float>& ray) {
  static_assert(glint::IdAovFor<A, S>);
  return variable.id(scene, scene.closest(ray));
}

const Ray<float> at_wall{.origin = {1, 0.5F, 2}, .direction = {0, 0, -3}};
const Ray<float> at_mirror{.origin = {1, 0.5F, 2}, .direction = {0, 0, 1}};
const Ray<float> past{.origin = {1, 0.5F, 2}, .direction = {0, 1, 0}};

}  // namespace

TEST_CASE("aov: what a wall shows of itself", "[integrator][aov]") {
  const Hall hall;
  CHECK(seen(aov::Albedo{}, hall.scene, at_wall) == red);
  CHECK(seen(aov::Normal{}, hall.scene, at_wall) == Vec3<float>(0, 0, 1));
  CHECK(seen(aov::Depth{}, hall.scene, at_wall) == 2);  // scene units, not multiples of the direction
  CHECK(seen(aov::Position{}, hall.scene, at_wall) == Vec3<float>(1, 0.5F, 0));
  CHECK(seen(aov::Uv{}, hall.scene, at_wall) == Vec2<float>(5.0F / 8, 2.5F / 4));
  CHECK(id(aov::PrimitiveId{}, hall.scene, at_wall) == 0);
  CHECK(id(aov::MaterialId{}, hall.scene, at_wall) == 0);
  CHECK(id(aov::InstanceId{}, hall.scene, at_wall) == none<std::uint32_t>);
}

TEST_CASE("aov: where nothing is, colors are black and normals zero, the others have no value", "[integrator][aov]") {
  const Hall hall;
  CHECK(seen(aov::Albedo{}, hall.scene, past) == Rgb{0});
  CHECK(seen(aov::Normal{}, hall.scene, past) == Vec3<float>(0));
  CHECK(seen(aov::DenoiseAlbedo{}, hall.scene, past) == Rgb{0});
  CHECK(seen(aov::DenoiseNormal{}, hall.scene, past) == Vec3<float>(0));
  CHECK_FALSE(seen(aov::Depth{}, hall.scene, past));
  CHECK_FALSE(seen(aov::Position{}, hall.scene, past));
  CHECK_FALSE(seen(aov::Uv{}, hall.scene, past));
  CHECK(id(aov::PrimitiveId{}, hall.scene, past) == none<std::uint32_t>);
  CHECK(id(aov::MaterialId{}, hall.scene, past) == none<std::uint32_t>);
  CHECK(id(aov::InstanceId{}, hall.scene, past) == none<std::uint32_t>);
}

TEST_CASE("aov: a mirror shows itself, and to denoisers what is in it", "[integrator][aov]") {
  const Hall hall;
  CHECK(seen(aov::Albedo{}, hall.scene, at_mirror) == tint);
  CHECK(seen(aov::Normal{}, hall.scene, at_mirror) == Vec3<float>(0, 0, -1));
  CHECK(seen(aov::DenoiseAlbedo{}, hall.scene, at_mirror) == tint * red);
  CHECK(seen(aov::DenoiseNormal{}, hall.scene, at_mirror) == Vec3<float>(0, 0, 1));
  CHECK(id(aov::PrimitiveId{}, hall.scene, at_mirror) == 1);
  CHECK(id(aov::MaterialId{}, hall.scene, at_mirror) == 1);
  CHECK(seen(aov::DenoiseAlbedo{}, hall.scene, at_wall) == red);
  // From behind, mirrors of the library are black.
  const Ray<float> from_behind{.origin = {1, 0.5F, 9}, .direction = {0, 0, -1}};
  CHECK(seen(aov::DenoiseAlbedo{}, hall.scene, from_behind) == Rgb{0});
}

TEST_CASE("aov: two mirrors that face each other show denoisers nothing", "[integrator][aov]") {
  Hall hall;
  const glint::Scene scene{glint::Bvh{glint::Elements{hall.walls}}, glint::Mirror{}};
  CHECK(seen(aov::DenoiseAlbedo{}, scene, at_mirror) == Rgb{0});
  CHECK(seen(aov::DenoiseNormal{}, scene, at_mirror) == Vec3<float>(0));
}

TEST_CASE("aov: through glass denoisers see what is behind and what is reflected, each by its share",
          "[integrator][aov]") {
  // A glass ball between the eye and a white wall in front, a black one behind the eye.
  const std::vector<glint::Quad<float>> walls{{{-90, -90, -9}, {180, 0, 0}, {0, 180, 0}},
                                              {{-90, -90, 9}, {0, 180, 0}, {180, 0, 0}}};
  const std::vector<glint::Sphere<float>> balls{{.center = {0, 0, 0}}};
  const glint::Bvh bvh{glint::Joined{glint::Elements{walls}, glint::Elements{balls}}};
  const glint::MaterialTable<Surface> materials{
      {glint::Lambertian{Rgb{1}}, glint::Lambertian{Rgb{0}}, glint::Dielectric{}}, {0, 1, 2}};
  const glint::Scene scene{bvh, materials};
  const Ray<float> ray{.origin = {0, 0, 5}, .direction = {0, 0, -1}};
  constexpr int count = 40'000;
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += static_cast<double>(seen(aov::DenoiseAlbedo{}, scene, ray, i)->g);
  // Head on, a surface reflects r = ((1.5 − 1) / (1.5 + 1))² = 0.04; light is reflected within any number of times:
  // through go (1 − r)² (1 + r² + r⁴ + …) = (1 − r)² / (1 − r²). Every path has weight 0 or 1.
  const double through = 0.96 * 0.96 / (1 - 0.04 * 0.04);
  CHECK(std::abs(sum / count - through) <= 4 * std::sqrt(through * (1 - through) / count));
}

TEST_CASE("aov: of placed objects, the object and the primitive in it", "[integrator][aov]") {
  using Affine = glint::Affine<float>;
  const std::vector<glint::Sphere<float>> pair{{.center = {-2, 0, 0}}, {.center = {2, 0, 0}}};
  const glint::Bvh object{glint::Elements{pair}};
  const std::vector placed{place(object, Affine::translate({0, 0, -5})), place(object, Affine::translate({0, 9, -5}))};
  const glint::Scene scene{glint::Bvh{glint::Instanced{placed}}};
  const Ray<float> upper_right{.origin = {2, 9, 0}, .direction = {0, 0, -1}};
  CHECK(id(aov::InstanceId{}, scene, upper_right) == 1);
  CHECK(id(aov::PrimitiveId{}, scene, upper_right) == 1);
  CHECK(id(aov::MaterialId{}, scene, upper_right) == 0);
  const Ray<float> lower_left{.origin = {-2, 0, 0}, .direction = {0, 0, -1}};
  CHECK(id(aov::InstanceId{}, scene, lower_left) == 0);
  CHECK(id(aov::PrimitiveId{}, scene, lower_left) == 0);
}

TEST_CASE("aov: light and statistics as they are handed over", "[integrator][aov]") {
  const glint::LightShares shares{.emission = Rgb{1}, .direct = Rgb{2}, .indirect = Rgb{3}, .sum = Rgb{6}};
  CHECK(aov::Emission{}.of_light(shares) == Rgb{1});
  CHECK(aov::Direct{}.of_light(shares) == Rgb{2});
  CHECK(aov::Indirect{}.of_light(shares) == Rgb{3});
  glint::SampleStatistics statistics;
  statistics.add(Rgb{1});
  statistics.add(Rgb{3});
  CHECK(aov::SampleCount{}.of_samples(statistics) == 2);
  CHECK(aov::Variance{}.of_samples(statistics) == Rgb{1});  // 2 for the samples, over 2
}

}  // namespace test_integrator_aov

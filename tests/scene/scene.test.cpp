// SPDX-License-Identifier: MIT
#include <glint/scene/scene.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/geometry/sphere.hpp>
#include <glint/light/area.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/material/material_table.hpp>
#include <glint/material/two_sided.hpp>

namespace test_scene_scene {

using glint::Bvh;
using glint::Elements;
using glint::Lambertian;
using glint::Ray;
using glint::Rgb;
using glint::Scene;
using glint::Sphere;
using glint::Vec3;

namespace {

const std::vector<Sphere<float>> two_spheres{{.center = {0, 0, -5}, .radius = 1}, {.center = {0, 0, -10}, .radius = 2}};

}  // namespace

TEST_CASE("scene: the closest surface is met, with its normal as the frame's z", "[scene]") {
  const Scene scene{Bvh{Elements{two_spheres}}};
  static_assert(glint::SceneLike<decltype(scene)>);
  const auto at = scene.interact(Ray<float>{.direction = {0, 0, -2}});
  REQUIRE(at);
  CHECK(at->primitive == 0);
  CHECK(at->surface.position.z == Approx(-4));
  CHECK(at->wo == Vec3<float>{0, 0, 1});
  CHECK(at->frame.z == at->surface.shading_normal);
  CHECK(at->to_local(at->wo).z == Approx(1));
  CHECK(at->to_world({0, 0, 1}) == at->surface.shading_normal);
  CHECK(at->light == glint::none<std::uint32_t>);
}

TEST_CASE("scene: a ray past everything meets nothing, and is not occluded", "[scene]") {
  const Scene scene{Bvh{Elements{two_spheres}}};
  CHECK_FALSE(scene.interact(Ray<float>{.direction = {0, 1, 0}}));
  CHECK_FALSE(scene.occluded(Ray<float>{.direction = {0, 1, 0}}));
  CHECK(scene.occluded(Ray<float>{}));
  CHECK_FALSE(scene.occluded(Ray<float>{.t_max = 3.5F}));
}

TEST_CASE("scene: a table gives each primitive its own material", "[scene]") {
  const glint::MaterialTable<Lambertian> table{{Lambertian{{0.1F}}, Lambertian{{0.9F}}}, {1, 0}};
  const Scene scene{Bvh{Elements{two_spheres}}, table};
  CHECK(scene.interact(Ray<float>{})->bsdf.reflectance == Rgb{0.9F});
  CHECK(scene.interact(Ray<float>{.origin = {0, 0, -20}, .direction = {0, 0, 1}})->bsdf.reflectance == Rgb{0.1F});
}

TEST_CASE("scene: lights at infinity add up in the background", "[scene]") {
  using Light = glint::OneOf<glint::ConstantEnvironment, glint::PointLight>;
  const glint::Lights<Light> lights{
      {glint::ConstantEnvironment{Rgb{1}}, glint::PointLight{}, glint::ConstantEnvironment{Rgb{2}}}};
  const Scene scene{Bvh{Elements{two_spheres}}, Lambertian{}, lights};
  CHECK(scene.background({0, 1, 0}) == Rgb{3});
  CHECK(scene.light_count() == 3);
  CHECK(scene.light_sampler().choose({}, {}, 0.5F).has_value());
  const auto infinite = scene.infinite_lights();
  CHECK(std::vector(infinite.begin(), infinite.end()) == std::vector<std::uint32_t>{0, 2});
}

TEST_CASE("scene: the way to choose among its lights is the user's choice", "[scene]") {
  const glint::Lights<glint::PointLight> lights{{glint::PointLight{{}, Rgb{1}}, glint::PointLight{{}, Rgb{3}}}};
  const Bvh geometry{Elements{two_spheres}};
  const Scene uniform{geometry, Lambertian{}, lights, glint::choose_by<glint::UniformLightSampler>};
  CHECK(uniform.light_sampler().probability({}, {}, 1) == 0.5F);
  const Scene by_power{geometry, Lambertian{}, lights, glint::choose_by<glint::PowerLightSampler>};
  CHECK(by_power.light_sampler().probability({}, {}, 1) == Approx(0.75F));
  static_assert(glint::SceneLike<decltype(uniform)>);
}

TEST_CASE("scene: the light that stands on a primitive is known where a ray meets it", "[scene]") {
  const std::vector<glint::Quad<float>> quads{{.origin = {-1, -1, -3}, .edge_u = {2, 0, 0}, .edge_v = {0, 2, 0}}};
  using Light = glint::AreaLight<glint::Quad<float>>;
  const Scene scene{Bvh{Elements{quads}}, Lambertian{}, glint::Lights<Light>{{Light{quads[0], Rgb{5}}}, {0}}};
  const auto at = scene.interact(Ray<float>{});
  REQUIRE(at);
  CHECK(at->light == 0);
  CHECK(emission(scene.light(at->light), at->surface, at->wo) == Rgb{5});
}

TEST_CASE("scene: geometry in double is shaded in float", "[scene]") {
  const std::vector<Sphere<double>> spheres{{.center = {0, 0, -5}, .radius = 1}};
  const Scene scene{Bvh{Elements{spheres}}, glint::TwoSidedMaterial{Lambertian{{0.5F}}}};
  const auto at = scene.interact(Ray<float>{});
  REQUIRE(at);
  CHECK(at->surface.position.z == -4.0F);
  CHECK(at->bsdf.front.reflectance == Rgb{0.5F});
  CHECK(scene.bounds().lower.z == -6.0F);
}

TEST_CASE("scene: an empty one is met by nothing", "[scene]") {
  const std::vector<Sphere<float>> none_at_all;
  const Scene scene{Bvh{Elements{none_at_all}}, Lambertian{}, glint::ConstantEnvironment{}};
  CHECK_FALSE(scene.interact(Ray<float>{}));
  CHECK(scene.background({0, 0, 1}) == Rgb{1});
}

}  // namespace test_scene_scene

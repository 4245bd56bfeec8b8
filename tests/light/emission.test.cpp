// SPDX-License-Identifier: MIT
#include <glint/light/emission.hpp>  // first, so the header proves it stands alone

#include <memory>
#include <string>
#include <vector>

#include <support/catch.hpp>

#include <glint/light/area.hpp>
#include <glint/light/directional.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/lights.hpp>
#include <glint/light/point.hpp>
#include <glint/light/spot.hpp>
#include <glint/light/triangle_sampler.hpp>
#include <glint/math/affine.hpp>
#include <glint/testing/light_laws.hpp>
#include <glint/texture/image_texture.hpp>

namespace test_light_emission {

using glint::AreaLight;
using glint::Rgb;
using glint::Vec2;
using glint::Vec3;

namespace {

const glint::Aabb<float> scene{{-1, -2, -3}, {4, 2, 1}};

template <typename L>
void check_laws(const L& light) {
  const auto violations = glint::testing::violations_of_emission_laws(light, scene, 5);
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

}  // namespace

TEST_CASE("emission: the rays of a point and of a spot carry its power", "[light][emission][laws]") {
  check_laws(glint::PointLight{.position = {1, 2, 3}, .intensity = Rgb{2}});
  check_laws(glint::SpotLight{.position = {1, 2, 3}, .direction = {1, 1, 0}});
  check_laws(glint::SpotLight{.cone_angle_radians = 2.5F, .falloff_start_radians = 0.5F});
}

TEST_CASE("emission: the rays of lights at infinity carry what falls on the scene", "[light][emission][laws]") {
  check_laws(glint::DirectionalLight{.direction = {1, -2, 3}, .irradiance = Rgb{3}});
  check_laws(glint::ConstantEnvironment{Rgb{2}});
  glint::Image image({8, 4}, Rgb{0.1F, 0.2F, 0.3F});
  image(5, 1) = Rgb{5, 4, 3};
  const glint::ImageTexture sky{.image = std::make_shared<const glint::Image>(image), .wrap_t = glint::Wrap::Clamp};
  const auto turn = glint::Affine<float>::rotate({1, 2, 3}, 1.0F);
  check_laws(glint::EnvironmentLight(sky, {64, 32}, Rgb{0.5F}, turn.linear));
}

TEST_CASE("emission: the rays of a surface carry its power", "[light][emission][laws]") {
  check_laws(AreaLight{glint::Quad<float>{.edge_u = {2, 0, 0}}, Rgb{1, 2, 3}});
  check_laws(AreaLight{glint::Disk<float>{.normal = {1, 2, -3}, .radius = 0.4F}, Rgb{1}});
  check_laws(AreaLight{glint::Sphere<float>{.center = {4, 5, 6}, .radius = 3}, Rgb{1}});
  check_laws(AreaLight{glint::Triangle<float>{{1, 2, 3}, {2, 2, 3}, {2, 5, 4}}, Rgb{1}});
  check_laws(AreaLight{glint::TriangleSampler({{{1, 2, 3}, {2, 2, 3}, {2, 5, 4}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}),
                       Rgb{1}});
}

TEST_CASE("emission: rays leave a surface on its outer side", "[light][emission]") {
  const AreaLight light{glint::Sphere<float>{.center = {4, 5, 6}, .radius = 3}, Rgb{1}};
  const auto out = light.emit({0.2F, 0.7F}, {0.4F, 0.1F}, scene);
  REQUIRE(out);
  CHECK(glm::distance(out->ray.origin, light.shape.center) > 3);
  CHECK_FALSE(intersect(out->ray, light.shape));
  CHECK_FALSE(out->is_delta_position);
  CHECK_FALSE(out->is_delta_direction);
}

TEST_CASE("emission: rays from infinity start before the scene and fall through its disk", "[light][emission]") {
  const glint::SceneDisk disk(scene);
  CHECK(disk.center == Vec3<float>{1.5F, 0, -1});
  CHECK(disk.radius == Approx(std::sqrt(57.0F) / 2));  // 5² + 4² + 4² = 57
  const Vec3<float> direction{0.6F, 0, 0.8F};
  for (const float x : {0.0F, 0.3F, 1.0F}) {
    const glint::Ray<float> ray = disk.ray(direction, {x, 0.6F});
    const Vec3<float> offset = ray.origin - disk.center;
    CHECK(glm::dot(offset, direction) == Approx(-disk.radius));
    CHECK(glm::length(glm::cross(offset, direction)) <= disk.radius * 1.00001F);
  }
}

TEST_CASE("emission: a scene without extent gets no light from infinity", "[light][emission]") {
  CHECK_FALSE(glint::DirectionalLight{}.emit({0.5F, 0.5F}, {0.5F, 0.5F}, {}));
  CHECK_FALSE(glint::ConstantEnvironment{}.emit({0.5F, 0.5F}, {0.5F, 0.5F}, {}));
}

TEST_CASE("emission: any light can be asked, also those that give off no rays", "[light][emission]") {
  using Any = glint::OneOf<glint::PointLight, glint::Darkness>;
  CHECK(emit(Any{glint::PointLight{}}, {0.5F, 0.5F}, {0.5F, 0.5F}, scene)->is_delta_position);
  CHECK_FALSE(emit(Any{glint::Darkness{}}, {0.5F, 0.5F}, {0.5F, 0.5F}, scene));
  CHECK(emission_pdf(Any{glint::PointLight{}}, {}, {0, 0, 1}, scene).position == 1);
  CHECK(emission_pdf(Any{glint::Darkness{}}, {}, {0, 0, 1}, scene) == glint::EmissionPdf{});
}

}  // namespace test_light_emission

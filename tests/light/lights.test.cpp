// SPDX-License-Identifier: MIT
#include <glint/light/lights.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/light/point.hpp>

namespace test_light_lights {

TEST_CASE("lights: a primitive that is not named does not shine", "[light][lights]") {
  const glint::Lights<glint::PointLight> lights{{glint::PointLight{}}, {glint::none<std::uint32_t>, 0}};
  CHECK(lights.at_primitive(0) == glint::none<std::uint32_t>);
  CHECK(lights.at_primitive(1) == 0);
  CHECK(lights.at_primitive(2) == glint::none<std::uint32_t>);
}

TEST_CASE("lights: darkness shines nowhere", "[light][lights]") {
  CHECK_FALSE(glint::Darkness{}.sample({0, 0, 0}, {0, 0}));
  CHECK(glint::Darkness{}.power({}) == glint::Rgb{0});
}

}  // namespace test_light_lights

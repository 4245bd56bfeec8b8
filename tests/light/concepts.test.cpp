// SPDX-License-Identifier: MIT
#include <glint/light/concepts.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/geometry/quad.hpp>
#include <glint/light/area.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>

namespace test_light_concepts {

using glint::AreaLight;
using glint::ConstantEnvironment;
using glint::OneOf;
using glint::PointLight;
using glint::Quad;
using glint::Rgb;

using AnyLight = OneOf<PointLight, AreaLight<Quad<float>>, ConstantEnvironment>;
static_assert(glint::Light<AnyLight>);

TEST_CASE("light: questions that a light has no answer to are answered by zero", "[light][concepts]") {
  const AnyLight point = PointLight{};
  CHECK(emission(point, glint::Surface{}, {0, 0, 1}) == Rgb{0});
  CHECK(surface_pdf(point, {0, 0, 1}, glint::Surface{}) == 0);
  CHECK(background(point, {0, 0, 1}) == Rgb{0});
  CHECK(background_pdf(point, {0, 0, 1}) == 0);
}

TEST_CASE("light: one of several answers as the one it is", "[light][concepts]") {
  const AnyLight area = AreaLight{Quad<float>{}, Rgb{3}};
  const AnyLight sky = ConstantEnvironment{Rgb{4}};
  CHECK(emission(area, glint::Surface{}, {0, 0, 1}) == Rgb{3});
  CHECK(surface_pdf(area, {0, 0, 8}, glint::Surface{}) == Approx(64));  // distance² / area / cosine = 64 / 1 / 1
  CHECK(background(sky, {0, 0, 1}) == Rgb{4});
  CHECK(background_pdf(sky, {0, 0, 1}) == Approx(0.25F / glint::pi<float>));
  CHECK(sky.sample(glint::Vec3<float>{0.0F}, glint::Vec2<float>{0.3F, 0.4F})->radiance == Rgb{4});
}

}  // namespace test_light_concepts

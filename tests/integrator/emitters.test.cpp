// SPDX-License-Identifier: MIT
#include <glint/integrator/emitters.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <support/catch.hpp>

#include <glint/bvh/bvh.hpp>
#include <glint/geometry/elements.hpp>
#include <glint/geometry/quad.hpp>
#include <glint/light/area.hpp>
#include <glint/light/environment.hpp>
#include <glint/light/point.hpp>
#include <glint/sampler/independent.hpp>
#include <glint/scene/scene.hpp>

namespace test_integrator_emitters {

TEST_CASE("emitters: the mean flux of rays is the power of all lights, and densities are as stated",
          "[integrator][emitters]") {
  using Light = glint::OneOf<glint::PointLight, glint::AreaLight<glint::Quad<float>>, glint::ConstantEnvironment>;
  const std::vector<glint::Quad<float>> quads{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}};
  const glint::Lights<Light> lights{{Light{glint::PointLight{{0, 1, 0}, glint::Rgb{2}}},
                                     Light{glint::AreaLight<glint::Quad<float>>{quads[0], glint::Rgb{1}}},
                                     Light{glint::ConstantEnvironment{glint::Rgb{0.5F}}}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{quads}}, glint::Lambertian{}, lights};
  const glint::Emitters emitters(scene);
  double power = 0;
  for (std::uint32_t i = 0; i < 3; ++i) {
    power += static_cast<double>(luminance(scene.light(i).power(scene.bounds())));
  }
  const glint::Independent sequence{.seed = 1};
  constexpr int n = 2000;
  for (int i = 0; i < n; ++i) {
    auto sampler = sequence.stream({0, 0}, i);
    const auto start = emitters.sample(scene, sampler);
    REQUIRE(start);
    // Chosen by power, and with each light's rays alike in flux, every ray carries the whole power.
    CHECK(static_cast<double>(luminance(start->flux())) == Approx(power).epsilon(1e-4));
    const glint::Surface at{.position = start->from.ray.origin, .normal = start->from.normal};
    const float stated = start->probability * start->from.pdf.position * start->from.pdf.direction;
    CHECK(emitters.pdf(scene.light(start->light), start->light, at, start->from.ray.direction) ==
          Approx(stated).epsilon(1e-3));
  }
}

TEST_CASE("emitters: in the dark nothing is chosen", "[integrator][emitters]") {
  const std::vector<glint::Quad<float>> quads{{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}};
  const glint::Scene scene{glint::Bvh{glint::Elements{quads}}};
  auto sampler = glint::Independent{}.stream({0, 0}, 0);
  CHECK_FALSE(glint::Emitters(scene).sample(scene, sampler));
}

}  // namespace test_integrator_emitters

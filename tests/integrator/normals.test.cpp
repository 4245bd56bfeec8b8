// SPDX-License-Identifier: MIT
#include <glint/integrator/normals.hpp>  // first, so the header proves it stands alone

#include <vector>

#include <integrator/rooms.hpp>
#include <support/catch.hpp>

#include <glint/geometry/sphere.hpp>
#include <glint/light/point.hpp>

namespace test_integrator_normals {

TEST_CASE("normals: components become colors, and nothing is black", "[integrator][normals]") {
  const std::vector<glint::Sphere<float>> ball{{.center = {0, 0, 0}, .radius = 1}};
  const glint::Scene scene{glint::Bvh{glint::Elements{ball}}, glint::Lambertian{glint::Rgb{0.5F}},
                           glint::PointLight{{0, 9, 0}, glint::Rgb{1}}};
  auto sampler = glint::Independent{}.stream({3, 4}, 0);
  const auto seen = [&](const glint::Vec3<float>& from) {
    return glint::Normals{}.radiance(scene, glint::Ray<float>{.origin = from, .direction = -from}, sampler);
  };
  const glint::Rgb right = seen({2, 0, 0});  // n = (1, 0, 0)
  CHECK(right.r == Approx(1));
  CHECK(right.g == Approx(0.5));
  CHECK(right.b == Approx(0.5));
  const glint::Rgb below = seen({0, -2, 0});  // n = (0, −1, 0)
  CHECK(below.r == Approx(0.5));
  CHECK(below.g == Approx(0).margin(1e-6));
  const glint::Ray<float> away{.origin = {2, 0, 0}, .direction = {1, 0, 0}};
  CHECK(glint::Normals{}.radiance(scene, away, sampler) == glint::Rgb{});
}

}  // namespace test_integrator_normals

// SPDX-License-Identifier: MIT
#include <glint/math/spherical.hpp>  // first, so the header proves it stands alone

#include <limits>
#include <random>

#include <nlohmann/json.hpp>

#include <support/catch.hpp>
#include <support/shared.hpp>

namespace test_math_spherical {

TEMPLATE_TEST_CASE("spherical: the inverse gives the direction back", "[math][spherical]", float, double) {
  std::mt19937 random(7);
  std::normal_distribution<TestType> normal;
  for (int i = 0; i < 2000; ++i) {
    const auto d = glm::normalize(glint::Vec3<TestType>(normal(random), normal(random), normal(random)));
    const auto uv = glint::direction_to_equirectangular(d);
    const auto back = glint::equirectangular_to_direction(uv);
    // u and v carry half an ulp of one, 2π and π of that in angle, and a few roundings.
    CHECK(glm::length(back - d) < 8 * std::numeric_limits<TestType>::epsilon());
    CHECK(glm::length(glint::direction_to_equirectangular(d * TestType(300)) - uv) <
          4 * std::numeric_limits<TestType>::epsilon());
  }
}

TEMPLATE_TEST_CASE("spherical: small angles from the zenith survive", "[math][spherical]", float, double) {
  // acos(cos 1e-4) in float is off by some percent; v must be 1e-4 / π.
  const auto angle = TestType(1e-4);
  const auto uv = glint::direction_to_equirectangular(glint::Vec3<TestType>(std::sin(angle), std::cos(angle), 0));
  CHECK(uv.y == Approx(angle * glint::inv_pi<TestType>).epsilon(1e-6));
  CHECK(uv.x == TestType(0.25));
}

TEMPLATE_TEST_CASE("spherical: every direction has a place in the panorama", "[math][spherical]", float, double) {
  const TestType nan = std::numeric_limits<TestType>::quiet_NaN();
  const TestType tiny = std::numeric_limits<TestType>::denorm_min();
  using Direction = glint::Vec3<TestType>;
  for (const Direction& d : {Direction(0), Direction(nan), Direction(nan, 1, 0), Direction(-tiny, 0, -1),
                             Direction(-TestType(1e-30), 0, -1), Direction(0, -1, 0), Direction(tiny, 1, tiny)}) {
    CAPTURE(d.x, d.y, d.z);
    const auto uv = glint::direction_to_equirectangular(d);
    CHECK((uv.x >= 0 && uv.x < 1));
    CHECK((uv.y >= 0 && uv.y <= 1));
  }
}

TEST_CASE("spherical: agrees with the environment mapping of the scene format", "[math][spherical][vectors]") {
  const auto text = glint::testing::shared_file("vectors/envmap.json");
  if (!text) return;
  const auto vectors = nlohmann::json::parse(*text);
  const double tolerance = vectors.at("tolerance").get<double>();
  for (const auto& expected : vectors.at("cases")) {
    CAPTURE(expected.dump());
    const auto& d = expected.at("dir_to_sky");
    const glint::Vec3<double> direction{d.at(0).get<double>(), d.at(1).get<double>(), d.at(2).get<double>()};
    const auto uv = glint::direction_to_equirectangular(direction);
    CHECK(uv.y == Approx(expected.at("uv").at(1).get<double>()).margin(tolerance));
    if (direction.x == 0 && direction.z == 0) continue;  // u is undefined at the poles
    CHECK(uv.x == Approx(expected.at("uv").at(0).get<double>()).margin(tolerance));
  }
}

}  // namespace test_math_spherical

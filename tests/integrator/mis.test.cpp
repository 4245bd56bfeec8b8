// SPDX-License-Identifier: MIT
#include <glint/integrator/mis.hpp>  // first, so the header proves it stands alone

#include <limits>

#include <support/catch.hpp>

namespace test_integrator_mis {

using glint::power_heuristic;

TEST_CASE("power heuristic: the weights of two strategies add up to one", "[integrator][mis]") {
  for (const float other : {1e-30F, 0.1F, 1.0F, 7.0F, 1e30F}) {
    CHECK(power_heuristic(2, other) + power_heuristic(other, 2) == Approx(1));
  }
  CHECK(power_heuristic(1, 2) == Approx(0.2F));  // 1² / (1² + 2²)
}

TEST_CASE("power heuristic: huge densities do not overflow, impossible ones weigh nothing", "[integrator][mis]") {
  CHECK(power_heuristic(1e38F, 1e38F) == Approx(0.5F));
  CHECK(power_heuristic(0, 1) == 0);
  CHECK(power_heuristic(1, 0) == 1);
  CHECK(power_heuristic(1, std::numeric_limits<float>::infinity()) == 0);
}

}  // namespace test_integrator_mis

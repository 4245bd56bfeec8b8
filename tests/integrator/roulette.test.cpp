// SPDX-License-Identifier: MIT
#include <glint/integrator/roulette.hpp>  // first, so the header proves it stands alone

#include <support/catch.hpp>

#include <glint/sampler/independent.hpp>

namespace test_integrator_roulette {

TEST_CASE("roulette: keeps the mean, and leaves strong paths alone", "[integrator][roulette]") {
  const glint::Independent sequence{.seed = 1};
  double sum = 0;
  constexpr int n = 20'000;
  for (int i = 0; i < n; ++i) {
    auto sampler = sequence.stream({0, 0}, i);
    glint::Rgb throughput{0.1F, 0.05F, 0};
    if (!glint::survives_roulette(throughput, 0.4F, sampler)) continue;
    CHECK(throughput.r == Approx(0.4));
    sum += static_cast<double>(throughput.g) / n;
  }
  // A quarter survives as 0.2: deviation of the mean 0.2 · √(3/16) / √n = 6.1e-4, four of them.
  CHECK(std::abs(sum - 0.05) < 2.5e-3);
  auto sampler = sequence.stream({0, 0}, 0);
  glint::Rgb strong{0.4F};
  CHECK(glint::survives_roulette(strong, 0.4F, sampler));
  CHECK(strong == glint::Rgb{0.4F});
}

}  // namespace test_integrator_roulette

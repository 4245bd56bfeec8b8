// SPDX-License-Identifier: MIT
#include <glint/sampler/independent.hpp>  // first, so the header proves it stands alone

#include <cstdint>
#include <string>

#include <glint/testing/sampler_laws.hpp>
#include <support/catch.hpp>

namespace test_sampler_independent {

using glint::Independent;

TEST_CASE("independent: obeys the laws of sample sequences", "[sampler][independent][laws]") {
  const auto seed = GENERATE(range(0U, 4U));
  CAPTURE(seed);
  const auto violations = glint::testing::violations_of_sampler_laws(Independent{.seed = seed});
  for (const std::string& violation : violations) UNSCOPED_INFO(violation);
  CHECK(violations.empty());
}

TEST_CASE("independent: numbers are those of philox with seven rounds", "[sampler][independent]") {
  auto sampler = Independent{.seed = 0x123456789ABCDEFU}.stream({3, 5}, 7);
  // key: the halves of the seed; counter: pixel, sample, block
  const auto first = glint::philox4x32<7>({3, 5, 7, 0}, {0x89ABCDEFU, 0x1234567U});
  const auto second = glint::philox4x32<7>({3, 5, 7, 1}, {0x89ABCDEFU, 0x1234567U});
  CHECK(sampler.next_1d() == glint::to_unit_float<float>(first[0]));
  const auto pair = sampler.next_2d();
  CHECK(pair.x == glint::to_unit_float<float>(first[1]));
  CHECK(pair.y == glint::to_unit_float<float>(first[2]));
  CHECK(sampler.next_2d().x == glint::to_unit_float<float>(second[0]));  // a pair does not straddle blocks
}

TEST_CASE("independent: seeds give different numbers", "[sampler][independent]") {
  CHECK(Independent{.seed = 1}.stream({0, 0}, 0).next_1d() != Independent{.seed = 2}.stream({0, 0}, 0).next_1d());
  CHECK(Independent{.seed = 1}.stream({0, 0}, 0).next_1d() !=
        Independent{.seed = 1 + (std::uint64_t{1} << 32)}.stream({0, 0}, 0).next_1d());
}

}  // namespace test_sampler_independent

// SPDX-License-Identifier: MIT
#include <glint/math/random.hpp>  // first, so the header proves it stands alone

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <support/catch.hpp>

namespace test_math_random {

using glint::mix;
using glint::philox4x32;
using glint::Random;
using glint::to_unit_float;

namespace {

using Block = std::array<std::uint32_t, 4>;

/// The known answers published with Random123 for ten rounds.
static_assert(philox4x32<10>({0, 0, 0, 0}, {0, 0}) == Block{0x6627e8d5U, 0xe169c58dU, 0xbc57ac4cU, 0x9b00dbd8U});

}  // namespace

TEST_CASE("random: philox gives the known answers of its authors", "[math][random]") {
  constexpr std::uint32_t ones = 0xffffffffU;
  CHECK(philox4x32<10>({ones, ones, ones, ones}, {ones, ones}) ==
        Block{0x408f276dU, 0x41c83b0eU, 0xa20bc7c6U, 0x6d5451fdU});
  CHECK(philox4x32<10>({0x243f6a88U, 0x85a308d3U, 0x13198a2eU, 0x03707344U}, {0xa4093822U, 0x299f31d0U}) ==
        Block{0xd16cfe09U, 0x94fdccebU, 0x5001e420U, 0x24126ea1U});
}

TEST_CASE("random: no rounds of philox return the counter", "[math][random]") {
  CHECK(philox4x32<0>({1, 2, 3, 4}, {5, 6}) == Block{1, 2, 3, 4});
}

TEST_CASE("random: all bits set stay below one and the leading bit is one half", "[math][random]") {
  CHECK(to_unit_float<float>(std::uint32_t{0xffffffffU}) == 1 - std::ldexp(1.0F, -24));
  CHECK(to_unit_float<float>(~std::uint64_t{0}) == 1 - std::ldexp(1.0F, -24));
  CHECK(to_unit_float<double>(~std::uint64_t{0}) == 1 - std::ldexp(1.0, -53));
  CHECK(to_unit_float<double>(std::uint32_t{0xffffffffU}) == 1 - std::ldexp(1.0, -32));
  CHECK(to_unit_float<float>(std::uint32_t{1} << 31) == 0.5F);
  CHECK(to_unit_float<double>(std::uint64_t{1} << 63) == 0.5);
  CHECK(to_unit_float<float>(std::uint32_t{0}) == 0.0F);
}

TEST_CASE("random: a flipped bit flips about half of the mixed bits", "[math][random]") {
  Random random{1};
  for (int bit = 0; bit < 64; ++bit) {
    int flips = 0;
    for (int i = 0; i < 256; ++i) {
      const std::uint64_t x = std::uint64_t{random.bits()} << 32 | random.bits();
      flips += std::popcount(mix(x) ^ mix(x ^ std::uint64_t{1} << bit));
    }
    // 256 · 64 fair coins: mean 8192, standard deviation √(16384 / 4) = 64.
    CAPTURE(bit);
    CHECK(std::abs(flips - 8192) < 5 * 64);
  }
}

TEST_CASE("random: the mix of two words depends on their order", "[math][random]") {
  CHECK(mix(1, 2) != mix(2, 1));
  CHECK(mix(0, 0) != 0);
}

TEST_CASE("random: equal seeds repeat, other seeds and streams differ", "[math][random]") {
  Random a{7, 3};
  Random b{7, 3};
  Random other_seed{8, 3};
  Random other_stream{7, 4};
  int equal_seed = 0;
  int equal_stream = 0;
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t bits = a.bits();
    CHECK(bits == b.bits());
    equal_seed += bits == other_seed.bits() ? 1 : 0;
    equal_stream += bits == other_stream.bits() ? 1 : 0;
  }
  CHECK(equal_seed == 0);  // the chance of one hit is 100 / 2³²
  CHECK(equal_stream == 0);
}

TEMPLATE_TEST_CASE("random: uniform numbers have the moments of the uniform distribution", "[math][random]", float,
                   double) {
  Random random{42};
  constexpr int count = 100'000;
  double sum = 0;
  double squares = 0;
  for (int i = 0; i < count; ++i) {
    const auto x = random.uniform<TestType>();
    REQUIRE(x >= 0);
    REQUIRE(x < 1);
    sum += double(x);
    squares += double(x) * double(x);
  }
  CHECK(std::abs(sum / count - 1.0 / 2) < 5 * std::sqrt(1.0 / 12 / count));      // variance of x: 1/12
  CHECK(std::abs(squares / count - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / count));  // variance of x²: 1/5 − 1/9
}

TEST_CASE("random: vectors are consecutive numbers", "[math][random]") {
  Random a{5};
  Random b{5};
  const glint::Vec2<float> two = a.uniform_vec2();
  const glint::Vec3<double> three = a.uniform_vec3<double>();
  CHECK(two.x == b.uniform<float>());
  CHECK(two.y == b.uniform<float>());
  CHECK(three.x == b.uniform<double>());
  CHECK(three.y == b.uniform<double>());
  CHECK(three.z == b.uniform<double>());
}

TEST_CASE("random: below() is in range and reaches each value equally often", "[math][random]") {
  Random random{9};
  std::array<int, 6> counts{};
  for (int i = 0; i < 60'000; ++i) ++counts.at(random.below(6));
  for (const int count : counts) CHECK(std::abs(count - 10'000) < 5 * 92);  // σ = √(60000 · 1/6 · 5/6) = 91.3
}

TEST_CASE("random: a range of its own is scaled", "[math][random]") {
  Random random{10};
  for (int i = 0; i < 1000; ++i) {
    const float x = random.uniform(-2.0F, 3.0F);
    REQUIRE(x >= -2.0F);
    REQUIRE(x <= 3.0F);
  }
}

}  // namespace test_math_random

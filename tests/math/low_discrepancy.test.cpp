// SPDX-License-Identifier: MIT
#include <glint/math/low_discrepancy.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glint/testing/chi_square.hpp>
#include <support/catch.hpp>

namespace test_math_low_discrepancy {

using glint::PrimeBase;
using glint::Random;

TEST_CASE("low discrepancy: reversing bits puts bit i at place 31 − i, in both halves of a long word at once",
          "[math][low_discrepancy]") {
  for (int i = 0; i < 32; ++i) CHECK(glint::reversed_bits(1U << i) == 0x80000000U >> i);
  Random random{1};
  for (int i = 0; i < 100; ++i) {
    const std::uint32_t a = random.bits();
    const std::uint32_t b = random.bits();
    CHECK(glint::reversed_bits(glint::reversed_bits(a)) == a);
    CHECK(glint::reversed_bits(std::uint64_t{a} << 32 | b) ==
          (std::uint64_t{glint::reversed_bits(b)} << 32 | glint::reversed_bits(a)));
  }
}

TEST_CASE("low discrepancy: Sobol's second coordinate is the sum of its direction numbers", "[math][low_discrepancy]") {
  // Of the primitive polynomial x + 1: v₁ = 1/2, vₖ₊₁ = vₖ + vₖ / 2 without carry.
  Random random{2};
  for (int i = 0; i < 200; ++i) {
    const std::uint32_t index = i < 100 ? static_cast<std::uint32_t>(i) : random.bits();
    std::uint32_t sum = 0;
    std::uint32_t direction = 0x80000000U;
    for (int bit = 0; bit < 32; ++bit, direction ^= direction >> 1) sum ^= (index >> bit & 1) * direction;
    const auto point = glint::sobol_point(index);
    CHECK(point[1] == sum);
    CHECK(point[0] == glint::reversed_bits(index));
  }
}

TEST_CASE("low discrepancy: the radical inverse mirrors digits at the point", "[math][low_discrepancy]") {
  CHECK(glint::radical_inverse<double>(0, 3) == 0);
  CHECK(glint::radical_inverse<double>(1, 3) == 1.0 / 3);
  CHECK(glint::radical_inverse<double>(11, 3) == 19.0 / 27);    // 102 → 0.201 = 2/3 + 1/27
  CHECK(glint::radical_inverse<float>(1234, 10) == 0.4321F);    // both the float nearest
  CHECK(glint::radical_inverse<float>(6, 2) == 0.375F);         // 110 → 0.011
  CHECK(glint::radical_inverse<float>(0xFFFFFFFFU, 2) < 1.0F);  // 1 − 2⁻³², which rounds to 1
}

TEST_CASE("low discrepancy: scrambling changes no bit by those above it, and loses nothing",
          "[math][low_discrepancy]") {
  Random random{3};
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t x = random.bits();
    const std::uint32_t seed = random.bits();
    const int bit = i % 32;
    const std::uint32_t below = (1U << bit) - 1;
    const std::uint32_t change = glint::scrambled_upward(x, seed) ^ glint::scrambled_upward(x ^ 1U << bit, seed);
    CHECK((change & below) == 0);
    CHECK((change >> bit & 1) == 1);  // so two words that differ first here still do: a bijection
    CHECK(glint::owen_scrambled(glint::reversed_bits(x), seed) ==
          glint::reversed_bits(glint::scrambled_upward(x, seed)));
  }
}

TEST_CASE("low discrepancy: over seeds, scrambled fractions that part at a digit are independent beyond it",
          "[math][low_discrepancy]") {
  // Owen's scrambling leaves of two fractions only where they part: where both are above that digit, and what they are
  // below it, is uniform. Three digits before it and three below of each make 2⁹ cases.
  const int parting = GENERATE(0, 1, 3, 7);
  CAPTURE(parting);
  Random random{static_cast<std::uint64_t>(parting)};
  std::vector<double> observed(512, 0.0);
  for (int i = 0; i < 51200; ++i) {
    const std::uint32_t seed = random.bits();
    const std::uint32_t a = 0xB5297A4DU;
    const std::uint32_t b = (a ^ 0x80000000U >> parting) ^ (0x3C6EF372U >> (parting + 1));
    const std::uint32_t image_a = glint::owen_scrambled(a, seed);
    const std::uint32_t image_b = glint::owen_scrambled(b, seed);
    REQUIRE(std::countl_zero(image_a ^ image_b) == parting);
    const auto below = [&](std::uint32_t x) { return x << (parting + 1) >> 29; };
    const std::uint32_t above = parting == 0 ? 0 : image_a >> (32 - parting) & 7;
    ++observed[above << 6 | below(image_a) << 3 | below(image_b)];
  }
  const std::size_t possible = 64U << std::min(parting, 3);
  observed.resize(possible);
  const std::vector<double> expected(possible, 51200.0 / static_cast<double>(possible));
  const auto result = glint::testing::chi_square(observed, expected, {.tests = 4});
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("low discrepancy: in a prime base, each interval of the first and of later powers holds one number",
          "[math][low_discrepancy]") {
  const auto prime = GENERATE(2U, 3U, 5U, 7U, 31U, 251U);
  CAPTURE(prime);
  const PrimeBase base(prime);
  for (std::uint32_t count = prime; count < 2000; count *= prime) {
    for (const std::uint32_t block : {0U, 3U, 65536U / count - 1}) {
      std::vector<int> intervals(count, 0);
      for (std::uint32_t i = block * count; i < (block + 1) * count; ++i) {
        const float x = base.scrambled_inverse(i, 77);
        REQUIRE(x >= 0);
        REQUIRE(x < 1);
        // 2⁻²⁴ for rounding downward: such a number may have left its interval, if only by that.
        ++intervals.at(static_cast<std::size_t>((static_cast<double>(x) + 0x1p-25) * count));
      }
      CAPTURE(count, block);
      CHECK(*std::max_element(intervals.begin(), intervals.end()) == 1);
    }
  }
}

TEST_CASE("low discrepancy: over keys, two numbers that part at a digit are independent beyond it, in a prime base",
          "[math][low_discrepancy]") {
  // 4 = 11 and 13 = 111 in base 3: the first two digits are the same, the third are not. So both fall in one ninth, and
  // there in two of its three intervals: 9 · 3 · 2 cases, all alike.
  const PrimeBase base(3);
  std::vector<double> observed(9 * 9, 0.0);
  for (std::uint64_t key = 0; key < 20000; ++key) {
    const auto a = static_cast<std::size_t>(base.scrambled_inverse(4, glint::mix(key, 1)) * 27);
    const auto b = static_cast<std::size_t>(base.scrambled_inverse(13, glint::mix(key, 1)) * 27);
    REQUIRE(a / 3 == b / 3);
    ++observed[a / 3 * 9 + a % 3 * 3 + b % 3];
  }
  std::vector<double> possible;
  for (std::size_t i = 0; i < observed.size(); ++i) {
    const bool same_digit = i % 9 / 3 == i % 3;
    if (same_digit) CHECK(observed[i] == 0);
    if (!same_digit) possible.push_back(observed[i]);
  }
  const std::vector<double> expected(possible.size(), 20000.0 / static_cast<double>(possible.size()));
  const auto result = glint::testing::chi_square(possible, expected);
  INFO(result.message);
  CHECK(result.passed);
}

TEST_CASE("low discrepancy: a scrambled number is uniform below its digits, too", "[math][low_discrepancy]") {
  // 251³ > 65536, so the third digit of any index is 0 or 1. What lies below is a part of a cell of 251⁻³.
  const PrimeBase base(251);
  std::vector<double> observed(16, 0.0);
  for (std::uint64_t key = 0; key < 16000; ++key) {
    const double cells = static_cast<double>(base.scrambled_inverse(5, glint::mix(key))) * 251 * 251;
    ++observed[static_cast<std::size_t>((cells - std::floor(cells)) * 16)];
  }
  const auto result = glint::testing::chi_square(observed, std::vector<double>(16, 1000.0));
  INFO(result.message);
  CHECK(result.passed);
}

}  // namespace test_math_low_discrepancy

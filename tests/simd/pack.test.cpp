// SPDX-License-Identifier: MIT
#include <glint/simd/pack.hpp>  // first, so the header proves it stands alone

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

#include <support/catch.hpp>

namespace test_simd_pack {

namespace {

using glint::Pack;

template <typename T>
T any_number(std::mt19937& random) {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  constexpr T infinity = std::numeric_limits<T>::infinity();
  constexpr std::array<T, 6> special{nan, infinity, -infinity, T(0), T(-0.0), T(1)};
  const auto bits = random();
  if (bits % 3 == 0) return special[random() % special.size()];
  return (T(random()) * T(0x1p-31) - T(1)) * T(1 << (bits % 8));
}

template <typename T>
bool same(T a, T b) {
  return a == b ? std::signbit(a) == std::signbit(b) : std::isnan(a) && std::isnan(b);
}

/// Every operation, lane by lane against the scalar one.
template <typename T, int N, int W>
void check_pack() {
  using P = Pack<T, N, W>;
  std::mt19937 random(N * 100 + W);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<T, std::size_t(N)> a{};
    std::array<T, std::size_t(N)> b{};
    for (auto* values : {&a, &b})
      for (T& x : *values) x = any_number<T>(random);
    const P p = P::load(a.data());
    const P q = P::load(b.data());
    const P least = min(p, q);
    const P most = max(p, q);
    std::array<T, std::size_t(N)> sum{};
    (p + q).store(sum.data());
    const P generated = P::generate([&](int i) { return a[std::size_t(i)]; });
    bool good = true;
    for (int i = 0; i < N; ++i) {
      good = good && same(generated[i], p[i]) && same(P::broadcast(a[0])[i], a[0]);
      const T x = a[std::size_t(i)];
      const T y = b[std::size_t(i)];
      good = good && same(p[i], x) && same(sum[std::size_t(i)], x + y) && same((p - q)[i], x - y) &&
             same((p * q)[i], x * y) && same((p / q)[i], x / y) && same(fenced(p)[i], x);
      good = good && same(least[i], x < y ? x : y) && same(most[i], x > y ? x : y);
      good = good && same(select(0x5A5A5A5AU, p, q)[i], (0x5A5A5A5AU >> i & 1U) != 0 ? x : y);
      good = good && ((less_equal(p, q) >> i) & 1U) == std::uint32_t(x <= y) &&
             ((less(p, q) >> i) & 1U) == std::uint32_t(x < y);
    }
    CHECK(good);
    CHECK((std::uint64_t{less_equal(p, q)} >> N) == 0);
  }
  // (1 + ε)(1 − ε) = 1 − ε² is rounded to 1; fused with the difference, −ε² would be left.
  const T epsilon = std::numeric_limits<T>::epsilon();
  const P product = fenced(P::broadcast(1 + epsilon) * P::broadcast(1 - epsilon)) - P::broadcast(1);
  for (int i = 0; i < N; ++i) CHECK(product[i] == 0);
  for (int i = 0; i < N; ++i) {
    P one = P::broadcast(T(2));
    one.set(i, T(-3));
    CHECK(lowest(one) == T(-3));
    CHECK(highest(one) == (N == 1 ? T(-3) : T(2)));
    one.set(i, T(5));
    CHECK(lowest(one) == (N == 1 ? T(5) : T(2)));
    CHECK(highest(one) == T(5));
  }
  P whole = P::broadcast(T(-2.75));
  CHECK(truncated(whole)[std::size_t(N - 1)] == -2);
  whole.set(N - 1, T(7.9));
  CHECK(truncated(whole)[std::size_t(N - 1)] == 7);
  CHECK(whole[0] == (N == 1 ? T(7.9) : T(-2.75)));
}

/// Bytes loaded as numbers, and lanes taken by comparison, one by one.
template <typename T, int N, int W>
void check_bytes() {
  using P = Pack<T, N, W>;
  std::mt19937 random(N * 100 + W);
  for (int trial = 0; trial < 50; ++trial) {
    std::array<std::uint8_t, std::size_t(N)> a{};
    std::array<std::uint8_t, std::size_t(N)> b{};
    for (auto* bytes : {&a, &b})
      for (std::uint8_t& byte : *bytes) byte = std::uint8_t(random());
    a[0] = std::uint8_t(trial % 2 == 0 ? 255 : 0);
    const P p = P::load(a.data());
    const P q = P::load(b.data());
    const P chosen = where_less_equal(p, q, P::broadcast(T(1)), P::broadcast(T(2)));
    bool good = true;
    for (int i = 0; i < N; ++i) {
      good = good && p[i] == T(a[std::size_t(i)]) && q[i] == T(b[std::size_t(i)]);
      good = good && chosen[i] == (a[std::size_t(i)] <= b[std::size_t(i)] ? T(1) : T(2));
    }
    CHECK(good);
  }
  const P nan = P::broadcast(std::numeric_limits<T>::quiet_NaN());
  CHECK(where_less_equal(nan, nan, P::broadcast(T(1)), P::broadcast(T(2)))[N - 1] == T(2));
}

}  // namespace

TEMPLATE_TEST_CASE("pack: every lane is computed as the number alone would be", "[simd]", float, double) {
  check_pack<TestType, 2, glint::register_lanes<TestType> == 1 ? 1 : 2>();
  check_pack<TestType, 4, (glint::register_lanes<TestType> < 4 ? glint::register_lanes<TestType> : 4)>();
  check_pack<TestType, 8, (glint::register_lanes<TestType> < 8 ? glint::register_lanes<TestType> : 8)>();
  check_pack<TestType, 16, (glint::register_lanes<TestType> < 16 ? glint::register_lanes<TestType> : 16)>();
}

TEMPLATE_TEST_CASE("pack: the fallback without vector registers does the same", "[simd]", float, double) {
  check_pack<TestType, 1, 1>();
  check_pack<TestType, 2, 1>();
  check_pack<TestType, 4, 1>();
  check_pack<TestType, 8, 1>();
  check_pack<TestType, 32, 1>();
}

TEST_CASE("pack: where either is NaN, min and max keep the second", "[simd]") {
  const auto nan = Pack<float, 4>::broadcast(std::numeric_limits<float>::quiet_NaN());
  const auto one = Pack<float, 4>::broadcast(1);
  CHECK(min(nan, one)[2] == 1);
  CHECK(max(nan, one)[2] == 1);
  CHECK(std::isnan(min(one, nan)[2]));
}

TEMPLATE_TEST_CASE("pack: bytes are loaded as the whole numbers they are", "[simd]", float, double) {
  check_bytes<TestType, 2, glint::register_lanes<TestType> == 1 ? 1 : 2>();
  check_bytes<TestType, 4, (glint::register_lanes<TestType> < 4 ? glint::register_lanes<TestType> : 4)>();
  check_bytes<TestType, 8, (glint::register_lanes<TestType> < 8 ? glint::register_lanes<TestType> : 8)>();
  check_bytes<TestType, 16, (glint::register_lanes<TestType> < 16 ? glint::register_lanes<TestType> : 16)>();
  check_bytes<TestType, 1, 1>();
  check_bytes<TestType, 8, 1>();
}

}  // namespace test_simd_pack

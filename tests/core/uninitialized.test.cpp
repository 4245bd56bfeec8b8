// SPDX-License-Identifier: MIT
#include <glint/core/uninitialized.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <cstdint>
#include <numeric>

#include <support/catch.hpp>

namespace test_core_uninitialized {

namespace {

struct alignas(64) Line {
  int value = 7;
};

}  // namespace

TEST_CASE("uninitialized: elements hold what is written to them, in copies too", "[core]") {
  glint::UninitializedVector<Line> lines;
  lines.resize(1000);
  for (std::size_t i = 0; i != lines.size(); ++i) lines[i].value = int(i);
  lines.push_back({1000});
  lines.resize(2000);
  const auto copy = lines;
  bool good = copy.size() == 2000;
  for (std::size_t i = 0; i != 1001; ++i) good = good && lines[i].value == int(i) && copy[i].value == int(i);
  CHECK(good);
}

TEST_CASE("uninitialized: elements are aligned as their type", "[core]") {
  glint::UninitializedVector<Line> lines;
  lines.resize(3);
  CHECK(reinterpret_cast<std::uintptr_t>(lines.data()) % 64 == 0);
}

TEST_CASE("uninitialized: a value that is asked for is there", "[core]") {
  const glint::UninitializedVector<int> sevens(5, 7);
  CHECK(sevens == glint::UninitializedVector<int>{7, 7, 7, 7, 7});
}

TEST_CASE("uninitialized vector: a large one begins on a large page, and grows and shrinks like any other", "[core]") {
  using Vector = glint::UninitializedVector<int>;
  constexpr std::size_t page = Vector::allocator_type::large_page;
  Vector v(4 * page / sizeof(int));
  CHECK(reinterpret_cast<std::uintptr_t>(v.data()) % page == 0);
  std::iota(v.begin(), v.end(), 0);
  v.resize(2 * v.size());
  CHECK(v[1'000'000] == 1'000'000);
  v.resize(10);
  v.shrink_to_fit();
  CHECK(v == Vector{0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
}

}  // namespace test_core_uninitialized

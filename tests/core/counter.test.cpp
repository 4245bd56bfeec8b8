// SPDX-License-Identifier: MIT
#include <glint/core/counter.hpp>  // first, so the header proves it stands alone

#include <algorithm>
#include <array>
#include <cstddef>
#include <thread>
#include <vector>

#include <support/catch.hpp>

namespace test_core_counter {

TEST_CASE("counter: numbers come in a row", "[core]") {
  glint::Counter counter(5);
  CHECK(counter.take(2) == 5);
  CHECK(counter.take(1) == 7);
  CHECK(counter.take(3) == 8);
  CHECK(counter.value() == 11);
}

TEST_CASE("counter: threads get each number once", "[core]") {
  constexpr std::size_t each = 20000;
  glint::Counter counter(1);
  std::array<std::vector<std::size_t>, 4> taken;
  {
    std::vector<std::jthread> threads;
    for (auto& mine : taken) {
      threads.emplace_back([&] {
        for (std::size_t i = 0; i != each; ++i) mine.push_back(counter.take(2));
      });
    }
  }
  std::vector<std::size_t> all;
  for (const auto& mine : taken) {
    CHECK(std::is_sorted(mine.begin(), mine.end()));
    all.insert(all.end(), mine.begin(), mine.end());
  }
  std::sort(all.begin(), all.end());
  bool odd_numbers_once = true;  // two at a time from 1 on: 1, 3, 5, …
  for (std::size_t i = 0; i != all.size(); ++i) odd_numbers_once = odd_numbers_once && all[i] == 2 * i + 1;
  CHECK(odd_numbers_once);
  CHECK(counter.value() == 1 + 2 * all.size());
}

}  // namespace test_core_counter

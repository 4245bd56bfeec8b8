// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include <glint/core/executor.hpp>

#include <support/catch.hpp>

namespace glint::support {

/// The ranges that a parallel_for hands out, in ascending order.
template <Executor E>
std::vector<std::pair<std::size_t, std::size_t>> ranges_of(const E& executor, std::size_t n, std::size_t grain) {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  std::mutex mutex;
  executor.parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    const std::lock_guard lock{mutex};
    ranges.emplace_back(begin, end);
  });
  std::sort(ranges.begin(), ranges.end());
  return ranges;
}

/// True where the ranges are non-empty, start at 0, follow each other without gap or overlap, and end at n.
inline bool partition(const std::vector<std::pair<std::size_t, std::size_t>>& ranges, std::size_t n) {
  std::size_t next = 0;
  for (const auto& [begin, end] : ranges) {
    if (begin != next || end <= begin) return false;
    next = end;
  }
  return next == n;
}

/// The n-th Fibonacci number by its definition: invocations nested as deep as n.
template <Executor E>
int fibonacci(const E& executor, int n) {
  if (n < 2) return n;
  int a = 0;
  int b = 0;
  executor.invoke([&] { a = fibonacci(executor, n - 1); }, [&] { b = fibonacci(executor, n - 2); });
  return a + b;
}

/// What the concept Executor promises, checked on one of its models.
template <Executor E>
void check_executor(const E& executor) {
  CHECK(executor.concurrency() >= 1);
  for (const std::size_t n : {1U, 2U, 7U, 64U, 1000U}) {
    for (const std::size_t grain : {1U, 3U, 64U, 5000U}) {
      CAPTURE(n, grain);
      CHECK(partition(ranges_of(executor, n, grain), n));
    }
  }
  CHECK(ranges_of(executor, 0, 1).empty());
  CHECK(fibonacci(executor, 12) == 144);

  const auto fails_at_500 = [](std::size_t begin, std::size_t end) {
    if (begin <= 500 && 500 < end) throw std::runtime_error("500");
  };
  CHECK_THROWS_AS(executor.parallel_for(1000, 10, fails_at_500), std::runtime_error);
  CHECK_THROWS_AS(executor.invoke([] { throw std::runtime_error("first"); }, [] {}), std::runtime_error);
  CHECK_THROWS_AS(executor.invoke([] {}, [] { throw std::runtime_error("second"); }), std::runtime_error);

  std::vector<int> counts(100, 0);  // nested loops each write their own row
  executor.parallel_for(10, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) {
      executor.parallel_for(10, 1, [&, row](std::size_t first, std::size_t last) {
        for (std::size_t column = first; column < last; ++column) ++counts[row * 10 + column];
      });
    }
  });
  CHECK(std::count(counts.begin(), counts.end(), 1) == 100);
}

}  // namespace glint::support

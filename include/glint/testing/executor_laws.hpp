// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include <glint/core/executor.hpp>
#include <glint/testing/violations.hpp>

namespace glint::testing {
namespace detail {

/// Whether each of n indices is handed out once, in ranges that are not empty.
template <Executor E>
[[nodiscard]] bool hands_out_each_once(const E& executor, std::size_t n, std::size_t grain) {
  std::vector<std::atomic<int>> counts(n);
  std::atomic<bool> lawful = true;
  executor.parallel_for(n, grain, [&](std::size_t begin, std::size_t end) {
    if (begin >= end || end > n) lawful = false;
    for (std::size_t i = begin; i < std::min(end, n); ++i) ++counts[i];
  });
  return lawful && std::all_of(counts.begin(), counts.end(), [](const auto& count) { return count == 1; });
}

/// The n-th Fibonacci number by its definition: invocations nested as deep as n.
template <Executor E>
[[nodiscard]] int fibonacci(const E& executor, int n) {
  if (n < 2) return n;
  int a = 0;
  int b = 0;
  executor.invoke([&] { a = fibonacci(executor, n - 1); }, [&] { b = fibonacci(executor, n - 2); });
  return a + b;
}

/// A loop of loops, each of which writes its own row.
template <Executor E>
[[nodiscard]] bool nests(const E& executor) {
  constexpr std::size_t rows = 10;
  std::vector<int> counts(rows * rows, 0);
  const auto count_row = [&](std::size_t row) {
    executor.parallel_for(rows, 1, [&, row](std::size_t begin, std::size_t end) {
      for (std::size_t column = begin; column < end; ++column) ++counts[row * rows + column];
    });
  };
  executor.parallel_for(rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t row = begin; row < end; ++row) count_row(row);
  });
  return std::count(counts.begin(), counts.end(), 1) == std::ptrdiff_t(counts.size());
}

template <typename F>
[[nodiscard]] bool rethrows(const F& f) {
  try {
    f();
  } catch (const std::runtime_error&) {
    return true;
  }
  return false;
}

}  // namespace detail

/// What an executor breaks of the laws of Executor, a sentence each; nothing where it keeps them all.
///
/// - parallel_for hands out each index once; invoke calls both; both may be nested, and rethrow what calls throw.
template <Executor E>
[[nodiscard]] std::vector<std::string> violations_of_executor_laws(const E& executor) {
  Violations violations;
  violations.expect(executor.concurrency() >= 1, "concurrency is at least one", executor.concurrency(), 1);
  for (const std::size_t n : {0U, 1U, 2U, 7U, 64U, 1000U}) {
    for (const std::size_t grain : {1U, 3U, 64U, 5000U}) {
      violations.expect(detail::hands_out_each_once(executor, n, grain), "parallel_for hands out each index once",
                        "of " + std::to_string(n) + ", by " + std::to_string(grain));
    }
  }
  violations.expect(detail::fibonacci(executor, 12) == 144, "invoke calls both, at any depth", "at a depth of 12");
  violations.expect(detail::nests(executor), "parallel_for may be nested", "in itself");
  const auto fails_at_500 = [](std::size_t begin, std::size_t end) {
    if (begin <= 500 && 500 < end) throw std::runtime_error("500");
  };
  const auto fails = [] { throw std::runtime_error("task"); };
  const auto works = [] {};
  violations.expect(detail::rethrows([&] { executor.parallel_for(1000, 10, fails_at_500); }),
                    "what a call throws is rethrown", "by parallel_for");
  violations.expect(detail::rethrows([&] { executor.invoke(fails, works); }) &&
                        detail::rethrows([&] { executor.invoke(works, fails); }),
                    "what a task throws is rethrown", "by invoke");
  return violations.take();
}

}  // namespace glint::testing

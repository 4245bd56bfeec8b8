// SPDX-License-Identifier: MIT
#include <glint/core/tbb_executor.hpp>  // first, so the header proves it stands alone

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include <support/catch.hpp>

#include <glint/testing/executor_laws.hpp>

namespace test_core_tbb_executor {

TEST_CASE("tbb executor: keeps what the concept promises, for any number of threads", "[core][tbb_executor]") {
  using glint::testing::violations_of_executor_laws;
  CHECK(violations_of_executor_laws(glint::TbbExecutor{}) == std::vector<std::string>{});
  for (const int threads : {1, 2, 5}) {
    CAPTURE(threads);
    CHECK(violations_of_executor_laws(glint::TbbExecutor{threads}) == std::vector<std::string>{});
  }
}

TEST_CASE("tbb executor: has as many threads as it was told, and at least one", "[core][tbb_executor]") {
  CHECK(glint::TbbExecutor{3}.concurrency() == 3);
  CHECK(glint::TbbExecutor{0}.concurrency() == 1);
  CHECK(glint::TbbExecutor{-7}.concurrency() == 1);
}

TEST_CASE("tbb executor: never runs more calls at once than it has threads", "[core][tbb_executor]") {
  const auto threads = GENERATE(range(1, 4));
  CAPTURE(threads);
  const glint::TbbExecutor executor{threads};
  std::atomic<int> running{0};
  std::atomic<int> most{0};
  executor.parallel_for(64, 1, [&](std::size_t, std::size_t) {
    const int now = ++running;
    for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    --running;
  });
  CHECK(most >= 1);
  CHECK(most <= threads);
}

TEST_CASE("tbb executor: two calls that wait for each other both get a thread", "[core][tbb_executor]") {
  // Each task takes the other's arrival for granted, up to ten seconds: one thread alone could not serve both.
  const glint::TbbExecutor executor{2};
  std::atomic<int> arrived{0};
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  const auto meet = [&] {
    ++arrived;
    while (arrived < 2 && std::chrono::steady_clock::now() < deadline) std::this_thread::yield();
  };
  executor.invoke(meet, meet);
  CHECK(std::chrono::steady_clock::now() < deadline);
}

TEST_CASE("tbb executor: may be shared by threads", "[core][tbb_executor]") {
  const glint::TbbExecutor executor{2};
  std::atomic<int> sum{0};
  const auto add = [&] {
    executor.parallel_for(1000, 10, [&](std::size_t begin, std::size_t end) { sum += static_cast<int>(end - begin); });
  };
  std::thread other(add);
  add();
  other.join();
  CHECK(sum == 2000);
}

}  // namespace test_core_tbb_executor

// SPDX-License-Identifier: MIT
#include <glint/core/executor.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <support/catch.hpp>

#include <glint/testing/executor_laws.hpp>

namespace test_core_executor {

TEST_CASE("executor: Serial keeps what the concept promises", "[core][executor]") {
  CHECK(glint::testing::violations_of_executor_laws(glint::Serial{}) == std::vector<std::string>{});
}

TEST_CASE("executor: Serial runs all in one range, on the calling thread", "[core][executor]") {
  std::vector<std::pair<std::size_t, std::size_t>> ranges;
  glint::Serial::parallel_for(1000, 1, [&](std::size_t begin, std::size_t end) { ranges.emplace_back(begin, end); });
  CHECK(ranges == std::vector<std::pair<std::size_t, std::size_t>>{{0, 1000}});
  std::thread::id id;
  glint::Serial::parallel_for(1, 1, [&](std::size_t, std::size_t) { id = std::this_thread::get_id(); });
  CHECK(id == std::this_thread::get_id());
}

TEST_CASE("executor: Serial invokes the first before the second", "[core][executor]") {
  int order = 0;
  glint::Serial::invoke([&] { order = 1; }, [&] { order = order * 10 + 2; });
  CHECK(order == 12);
}

TEST_CASE("executor: what cannot split a loop is no Executor", "[core][executor]") {
  struct OnlyInvokes {
    static int concurrency() { return 1; }
    static void invoke(void (*f)(), void (*g)()) {
      f();
      g();
    }
  };
  STATIC_REQUIRE(glint::Executor<glint::Serial>);
  STATIC_REQUIRE_FALSE(glint::Executor<OnlyInvokes>);
  STATIC_REQUIRE_FALSE(glint::Executor<int>);
}

}  // namespace test_core_executor

// SPDX-License-Identifier: MIT
#include <glint/testing/executor_laws.hpp>  // first, so the header proves it stands alone

#include <cstddef>
#include <string>
#include <vector>

#include <support/catch.hpp>

namespace test_testing_executor_laws {

namespace {

using glint::Serial;
using glint::testing::violations_of_executor_laws;

/// Serial, but for what a slip overrides.
struct Lawful {
  [[nodiscard]] static int concurrency() { return 1; }
  template <typename Body>
  static void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
    Serial::parallel_for(n, grain, body);
  }
  template <typename F, typename G>
  static void invoke(const F& f, const G& g) {
    Serial::invoke(f, g);
  }
};

struct ForgetsTheRest : Lawful {
  template <typename Body>
  static void parallel_for(std::size_t n, std::size_t grain, const Body& body) {
    for (std::size_t begin = 0; begin + grain <= n; begin += grain) body(begin, begin + grain);
  }
};

struct Swallows : Lawful {
  template <typename F, typename G>
  static void invoke(const F& f, const G& g) {
    try {
      Serial::invoke(f, g);
    } catch (...) {
      return;
    }
  }
};

struct CallsOne : Lawful {
  template <typename F, typename G>
  static void invoke(const F& f, const G& /*g*/) {
    f();
  }
};

}  // namespace

TEST_CASE("executor laws: hold for what runs everything", "[testing][executor_laws]") {
  CHECK(violations_of_executor_laws(Lawful{}).empty());
}

TEST_CASE("executor laws: find lost indices, lost tasks and lost exceptions", "[testing][executor_laws]") {
  const auto lost = violations_of_executor_laws(ForgetsTheRest{});
  REQUIRE_FALSE(lost.empty());
  CHECK(lost.front() == "parallel_for hands out each index once: of 1, by 3");
  CHECK(violations_of_executor_laws(Swallows{}) ==
        std::vector<std::string>{"what a task throws is rethrown: by invoke"});
  CHECK(violations_of_executor_laws(CallsOne{}).size() == 2);
}

}  // namespace test_testing_executor_laws

// SPDX-License-Identifier: MIT
#pragma once
#include <concepts>
#include <cstddef>
#include <utility>

namespace glint {

/// Where work runs. The library starts no threads; whoever wants parallelism hands in an executor.
///
/// `parallel_for(n, grain, body)` calls `body(begin, end)` for half-open ranges that partition [0, n), in any order
/// and possibly at once; `grain` ≥ 1 is the smallest range worth a task of its own. `invoke(f, g)` calls both,
/// possibly at once. Both return when all calls have returned. An exception thrown by a call is rethrown.
///
/// Results must not depend on the executor: library algorithms promise the same bits for every executor.
template <typename E>
concept Executor = requires(const E& executor, std::size_t n, void (*body)(std::size_t, std::size_t), void (*task)()) {
  { executor.concurrency() } -> std::convertible_to<int>;
  executor.parallel_for(n, n, body);
  executor.invoke(task, task);
};

/// Runs everything on the calling thread, in order.
struct Serial {
  [[nodiscard]] static constexpr int concurrency() noexcept { return 1; }

  template <std::invocable<std::size_t, std::size_t> Body>
  static void parallel_for(std::size_t n, std::size_t /*grain*/, Body&& body) {
    if (n != 0) std::forward<Body>(body)(std::size_t{0}, n);
  }

  template <std::invocable F, std::invocable G>
  static void invoke(F&& f, G&& g) {
    std::forward<F>(f)();
    std::forward<G>(g)();
  }
};

static_assert(Executor<Serial>);

}  // namespace glint

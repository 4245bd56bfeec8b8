// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/task_arena.h>

#include <glint/core/executor.hpp>

namespace glint {

/// Runs work on oneTBB, in an arena of its own, so that the number of threads holds for what runs through it alone.
///
/// Threads: may be shared by threads; nested use is fine. Copying would split the arena, so it cannot be copied.
class TbbExecutor {
 public:
  /// As many threads as the machine has.
  TbbExecutor() = default;
  /// `threads` threads, the caller's included, more than the machine has if need be; fewer than one count as one.
  explicit TbbExecutor(int threads)
      : allowed_(tbb::global_control::max_allowed_parallelism,
                 std::max(static_cast<std::size_t>(std::max(1, threads)),
                          tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism))),
        arena_(std::max(1, threads)) {}

  [[nodiscard]] int concurrency() const { return arena_.max_concurrency(); }

  template <std::invocable<std::size_t, std::size_t> Body>
  void parallel_for(std::size_t n, std::size_t grain, Body&& body) const {
    using Range = tbb::blocked_range<std::size_t>;
    arena_.execute([&] {
      tbb::parallel_for(Range(0, n, std::max<std::size_t>(1, grain)),
                        [&](const Range& range) { body(range.begin(), range.end()); });
    });
  }

  template <std::invocable F, std::invocable G>
  void invoke(F&& f, G&& g) const {
    arena_.execute([&] { tbb::parallel_invoke(f, g); });
  }

 private:
  tbb::global_control allowed_{tbb::global_control::max_allowed_parallelism,
                               tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)};
  mutable tbb::task_arena arena_;
};

static_assert(Executor<TbbExecutor>);

}  // namespace glint

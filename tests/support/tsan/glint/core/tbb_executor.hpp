// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <glint/core/executor.hpp>

namespace glint {

/// Stands in for the real TbbExecutor in builds with the thread sanitizer, by coming first on the include path.
///
/// Distributions' oneTBB is not instrumented: the sanitizer does not see how it hands work from thread to thread, and
/// reports races where there are none. Suppressing those would suppress ours with them. These threads are all visible.
class TbbExecutor {
 public:
  TbbExecutor() : TbbExecutor(4) {}
  explicit TbbExecutor(int threads) : threads_(std::max(1, threads)), spare_(threads_ - 1) {}

  [[nodiscard]] int concurrency() const { return threads_; }

  template <std::invocable<std::size_t, std::size_t> Body>
  void parallel_for(std::size_t n, std::size_t grain, Body&& body) const {
    std::atomic<std::size_t> next{0};
    const std::size_t step = std::max<std::size_t>(1, grain);
    const auto work = [&] {
      for (std::size_t begin = next.fetch_add(step); begin < n; begin = next.fetch_add(step)) {
        body(begin, std::min(n, begin + step));
      }
    };
    Team team{*this};
    for (int i = 1; i < threads_; ++i) team.try_start(work);
    team.run(work);
  }

  template <std::invocable F, std::invocable G>
  void invoke(F&& f, G&& g) const {
    Team team{*this};
    const bool apart = team.try_start(std::ref(g));
    team.run(f);
    if (!apart) team.run(g);
  }

 private:
  /// Threads that are joined, and the first exception, which is rethrown once all are done.
  class Team {
   public:
    explicit Team(const TbbExecutor& executor) : executor_(executor) {}
    Team(const Team&) = delete;
    Team& operator=(const Team&) = delete;
    ~Team() noexcept(false) {
      for (std::thread& thread : threads_) thread.join();
      executor_.spare_ += static_cast<int>(threads_.size());
      if (error_) std::rethrow_exception(error_);
    }

    template <typename F>
    void run(F&& f) {
      try {
        f();
      } catch (...) {
        const std::lock_guard lock{mutex_};
        if (!error_) error_ = std::current_exception();
      }
    }

    template <typename F>
    bool try_start(F f) {
      if (executor_.spare_.fetch_sub(1) <= 0) {
        ++executor_.spare_;
        return false;
      }
      threads_.emplace_back([this, f] { run(f); });
      return true;
    }

   private:
    const TbbExecutor& executor_;
    std::vector<std::thread> threads_;
    std::mutex mutex_;
    std::exception_ptr error_;
  };

  int threads_;
  mutable std::atomic<int> spare_;
};

static_assert(Executor<TbbExecutor>);

}  // namespace glint

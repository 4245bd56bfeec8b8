// SPDX-License-Identifier: MIT
#pragma once
#include <pthread.h>

#include <csignal>
#include <ctime>
#include <stop_token>
#include <thread>

/// Turns Ctrl-C, and a polite request to terminate, into a stop request. While it lives, neither ends the program.
/// Threads started before it would take the signals their own way.
class InterruptWatcher {
 public:
  InterruptWatcher() : signals_(watched()) {
    pthread_sigmask(SIG_BLOCK, &signals_, &former_);
    waiting_ = std::jthread([this](const std::stop_token& ended) { wait(ended); });
  }
  InterruptWatcher(const InterruptWatcher&) = delete;
  InterruptWatcher& operator=(const InterruptWatcher&) = delete;
  ~InterruptWatcher() {
    waiting_.request_stop();
    waiting_.join();
    pthread_sigmask(SIG_SETMASK, &former_, nullptr);
  }

  [[nodiscard]] std::stop_token token() const { return interrupt_.get_token(); }

 private:
  [[nodiscard]] static sigset_t watched() {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGINT);
    sigaddset(&signals, SIGTERM);
    return signals;
  }

  void wait(const std::stop_token& ended) {
    constexpr timespec patience{.tv_sec = 0, .tv_nsec = 50'000'000};
    while (!ended.stop_requested()) {
      if (sigtimedwait(&signals_, nullptr, &patience) > 0) interrupt_.request_stop();
    }
  }

  sigset_t signals_;
  sigset_t former_{};
  std::stop_source interrupt_;
  std::jthread waiting_;
};

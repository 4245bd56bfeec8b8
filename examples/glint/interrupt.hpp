// SPDX-License-Identifier: MIT
#pragma once
#include <pthread.h>

#include <csignal>
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
    pthread_kill(waiting_.native_handle(), SIGTERM);  // to that thread alone, which waits for one
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
    int signal = 0;
    while (sigwait(&signals_, &signal) == 0 && !ended.stop_requested()) interrupt_.request_stop();
  }

  sigset_t signals_;
  sigset_t former_{};
  std::stop_source interrupt_;
  std::jthread waiting_;
};

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <support/timing.hpp>

/// Two that do the same work in turns.
namespace glint::bench {

/// Processor time of each repetition: of the whole process, so that nothing is hidden in threads.
class Turns {
 public:
  explicit Turns(bool quick) : repetitions_(quick ? 3 : 9) {}

  /// Each does all of `count` things, `slice` of them at a time, `ours(first, count)` and then `theirs`, or the other
  /// way around in every second turn. One repetition to warm up, then as many as take both long enough.
  template <typename Ours, typename Theirs>
  void run(std::size_t count, std::size_t slice, const Ours& ours, const Theirs& theirs) {
    repeat(count, slice, ours, theirs);
    const double shortest = std::min(our_times_[0], their_times_[0]);
    const int rounds = repetitions_ == 3 ? 1 : std::clamp(int(std::ceil(0.02 / shortest)), 1, 1000);
    our_times_.clear();
    their_times_.clear();
    for (int repetition = 0; repetition < repetitions_; ++repetition) {
      repeat(count, slice, ours, theirs);
      for (int round = 1; round < rounds; ++round) {
        repeat(count, slice, ours, theirs);
        our_times_.end()[-2] += our_times_.back();
        their_times_.end()[-2] += their_times_.back();
        our_times_.pop_back();
        their_times_.pop_back();
      }
    }
  }
  /// The same for one piece of work, with `before()` ahead of each turn, in nobody's time.
  template <typename Before, typename Ours, typename Theirs>
  void run_after(const Before& before, const Ours& ours, const Theirs& theirs) {
    for (int repetition = 0; repetition <= repetitions_; ++repetition) {
      before();
      repeat(
          1, 1, [&](std::size_t, std::size_t) { ours(); }, [&](std::size_t, std::size_t) { theirs(); });
    }
    our_times_.erase(our_times_.begin());
    their_times_.erase(their_times_.begin());
  }

  void print(const std::string& mesh, const char* what, const char* ours, const char* theirs) const {
    std::printf("RATIO %s %s %s %s %.3f\n", mesh.c_str(), what, ours, theirs, median_ratio(their_times_, our_times_));
  }

 private:
  template <typename Ours, typename Theirs>
  void repeat(std::size_t count, std::size_t slice, const Ours& ours, const Theirs& theirs) {
    our_times_.push_back(0);
    their_times_.push_back(0);
    for (std::size_t first = 0; first < count; first += slice, ++turn_) {
      const std::size_t some = std::min(slice, count - first);
      const auto take_ours = [&] {
        our_times_.back() += seconds_of(CLOCK_PROCESS_CPUTIME_ID, [&] { ours(first, some); });
      };
      if (turn_ % 2 == 0) take_ours();
      their_times_.back() += seconds_of(CLOCK_PROCESS_CPUTIME_ID, [&] { theirs(first, some); });
      if (turn_ % 2 != 0) take_ours();
    }
  }

  int repetitions_;
  std::size_t turn_ = 0;
  std::vector<double> our_times_;
  std::vector<double> their_times_;
};

}  // namespace glint::bench

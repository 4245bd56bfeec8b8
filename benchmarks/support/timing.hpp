// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

/// Times that others on the machine disturb little.
namespace glint::bench {

/// What a clock says. CLOCK_THREAD_CPUTIME_ID and CLOCK_PROCESS_CPUTIME_ID stand still while others have the processor.
[[nodiscard]] inline double seconds(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

template <typename Work>
[[nodiscard]] double seconds_of(clockid_t clock, const Work& work) {
  const double begin = seconds(clock);
  work();
  return seconds(clock) - begin;
}

/// The middle one, or between the two in the middle. Requires: at least one.
[[nodiscard]] inline double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*middle + *std::max_element(values.begin(), middle)) / 2;
}

/// The median of what each repetition's ratio is.
[[nodiscard]] inline double median_ratio(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < above.size(); ++i) ratios.push_back(above[i] / below[i]);
  return median(ratios);
}

}  // namespace glint::bench

// SPDX-License-Identifier: MIT
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include <integrator/rooms.hpp>

/// The lines of the table: what was expected, what came out, and whether chance alone explains the difference.
namespace correctness {

struct Row {
  std::string what;
  double expected = 0;
  Estimate measured;
  double also = 0;  ///< the standard error of what was expected, where that was measured too

  /// In standard errors. What is further off than rounding, and has no noise to explain it, is infinitely so.
  [[nodiscard]] double z() const {
    const double off = std::abs(measured.mean - expected);
    if (off <= 2e-5 * std::abs(expected)) return 0;
    return off / std::hypot(measured.error, also);
  }
};

/// The z that one of `rows` right ones exceeds with a chance of `alpha`: each is tested at alpha / rows.
[[nodiscard]] inline double critical_z(double alpha, std::size_t rows) {
  const double tail = alpha / static_cast<double>(rows);  // of both sides: erfc(z / √2)
  double low = 0;
  double high = 20;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2.0)) > tail ? low : high) = middle;
  }
  return high;
}

/// Prints a table, and says whether all of it holds.
[[nodiscard]] inline bool print(const std::string& title, const std::vector<Row>& rows, double alpha) {
  const double limit = critical_z(alpha, rows.size());
  std::printf("\n### %s\n\nα = %g over %zu rows: |z| below %.2f holds.\n\n", title.c_str(), alpha, rows.size(), limit);
  std::printf("| what | expected | measured | standard error | z | |\n|---|---|---|---|---|---|\n");
  bool all = true;
  for (const Row& row : rows) {
    const bool holds = row.z() < limit;
    all = all && holds;
    std::printf("| %s | %.6g | %.6g | %.1e | %.1f | %s |\n", row.what.c_str(), row.expected, row.measured.mean,
                std::hypot(row.measured.error, row.also), row.z(), holds ? "holds" : "**fails**");
  }
  return all;
}

}  // namespace correctness

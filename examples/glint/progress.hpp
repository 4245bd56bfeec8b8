// SPDX-License-Identifier: MIT
#pragma once
#include <unistd.h>

#include <cstdio>
#include <string>

#include <glint/render/options.hpp>

/// 75 s as "1:15", 4000 s as "1:06:40", shorter times as "7.3 s".
inline std::string clock_time(double seconds) {
  char text[32];
  if (seconds < 60) {
    std::snprintf(text, sizeof text, "%.1f s", seconds);
    return text;
  }
  const long whole = static_cast<long>(seconds + 0.5);
  if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ld:%02ld", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
  }
  return text;
}

/// Shows how far a rendering is, on stderr: a bar on a terminal, a line for each tenth elsewhere.
class ProgressDisplay {
 public:
  ProgressDisplay() {
    if (terminal_) draw_bar(0, 0, "?");
  }
  ProgressDisplay(const ProgressDisplay&) = delete;
  ProgressDisplay& operator=(const ProgressDisplay&) = delete;
  /// What follows begins on a line of its own.
  ~ProgressDisplay() {
    if (terminal_) std::fputc('\n', stderr);
  }

  void operator()(const glint::RenderProgress& progress) {
    const double done = static_cast<double>(progress.samples_done) / static_cast<double>(progress.samples_total);
    const double left = progress.seconds / done - progress.seconds;
    if (terminal_) {
      draw_bar(done, progress.seconds, clock_time(left));
    } else if (const int tenth = static_cast<int>(done * 10); tenth > last_tenth_) {
      last_tenth_ = tenth;
      std::fprintf(stderr, "%3d %%  elapsed %s  left %s\n", tenth * 10, clock_time(progress.seconds).c_str(),
                   clock_time(left).c_str());
    }
  }

 private:
  /// Ten times a second at most: a terminal is slower than a tile.
  void draw_bar(double done, double elapsed, const std::string& left) {
    if (elapsed < next_draw_ && done < 1) return;
    next_draw_ = elapsed + 0.1;
    constexpr int width = 30;
    const int filled = static_cast<int>(done * width);
    std::string bar(static_cast<std::size_t>(filled), '#');
    bar.resize(width, '.');
    std::fprintf(stderr, "\r[%s] %3d %%  elapsed %s  left %s   ", bar.c_str(), static_cast<int>(done * 100),
                 clock_time(elapsed).c_str(), left.c_str());
  }

  bool terminal_ = isatty(STDERR_FILENO) != 0;
  int last_tenth_ = 0;
  double next_draw_ = 0;
};

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Progress on stderr: on a terminal a bar with speed and remaining time; otherwise one line
/// per decade of progress.
#pragma once
#include <chrono>

namespace rondo::app {

class Progress {
 public:
  explicit Progress(const char* unit);  ///< what is counted: "step"
  ~Progress();                          ///< ends the line of an unfinished bar
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  void operator()(long long done, long long total);

 private:
  using Clock = std::chrono::steady_clock;
  void draw_bar(long long done, long long total, double seconds) const;

  const char* unit_;
  bool terminal_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_ = start_;
  int decade_ = 0;
  long long first_ = -1;  ///< count at the first call; -1: not called yet
  bool open_ = false;     ///< whether a bar is on the present line
};

}  // namespace rondo::app

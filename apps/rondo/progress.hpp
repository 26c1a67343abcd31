// SPDX-License-Identifier: BSD-3-Clause
/// @file  Progress on stderr: a bar with speed and time left on a terminal; elsewhere one line a
/// decade of progress.
#pragma once
#include <chrono>

namespace rondo::app {

class Progress {
 public:
  explicit Progress(const char* unit);  ///< what is counted: "step"
  ~Progress();                          ///< a bar that did not reach its end gets its new line
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
  long long first_ = -1;  ///< done before the first call; -1: not called yet
  bool open_ = false;     ///< a bar stands on the line
};

}  // namespace rondo::app

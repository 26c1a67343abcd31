// SPDX-License-Identifier: BSD-3-Clause
/// @file  Progress of jobs (rondo/study/jobs.hpp): on a terminal one line with the overall share,
/// the time gone and left and the jobs that run; elsewhere a line as each job ends. Failures are
/// printed always. What cannot be printed is left out: a stream that breaks ends no job.
#pragma once
#include <chrono>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "rondo/study/sweep/jobs.hpp"

namespace rondo::app {

class JobProgress {
 public:
  /// @param out stderr; another stream in the tests
  explicit JobProgress(std::span<const study::Job> jobs, std::FILE* out = stderr);
  ~JobProgress();  ///< a bar gets its new line
  JobProgress(const JobProgress&) = delete;
  JobProgress& operator=(const JobProgress&) = delete;

  void ended(std::size_t job, const study::JobOutcome& outcome);  ///< for JobsOptions::ended
  void draw(const study::JobsProgress& progress);                 ///< for JobsOptions::progress

 private:
  std::vector<std::string> names_;
  std::FILE* out_;
  bool terminal_;
  bool open_ = false;  ///< a bar stands on the line
  std::size_t ended_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// " 3 of 33  turn-smooth: done in 1.4 s"; lines of a message beyond the first are indented.
[[nodiscard]] std::string ended_line(std::size_t ended, std::size_t total, const std::string& name,
                                     const study::JobOutcome& outcome);

/// "[####    ]  48 %  3 min 20 s, 3 min 37 s left  turn-smooth, turn-tread", shorter than `width`.
[[nodiscard]] std::string bar_line(double share, double seconds,
                                   const std::vector<std::string>& running, int width);

}  // namespace rondo::app

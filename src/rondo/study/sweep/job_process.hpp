// SPDX-License-Identifier: BSD-3-Clause
/// @file  The process of one job (jobs.hpp), and its report, which comes back through a pipe.
#pragma once
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <string>

#include "rondo/study/sweep/jobs.hpp"

namespace rondo::study {

/// A running child as its parent sees it. The parent ends it with finish_job, whatever happens.
struct JobProcess {
  std::size_t job = 0;
  pid_t pid = -1;
  int pipe = -1;         ///< end to read from
  std::string received;  ///< of the report, so far
  std::chrono::steady_clock::time_point start;
};

/// Starts the job in a child, which writes its progress to `share`.
/// @throws FileError
[[nodiscard]] JobProcess start_job(const Job& job, std::size_t index, std::atomic<double>& share);

/// Reads what the pipe holds; waits if it holds nothing. False at its end: the child is over.
[[nodiscard]] bool read_report(JobProcess& process);

/// Closes the pipe and waits for the end of the child.
[[nodiscard]] JobOutcome finish_job(const JobProcess& process);

}  // namespace rondo::study

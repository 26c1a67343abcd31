// SPDX-License-Identifier: BSD-3-Clause
/// @file  Independent pieces of work over the cores, several at once, each in a process of its own:
/// the HDF5 library is not safe for threads, the number of BLAS's threads is a setting of the
/// process, peak memory is then each job's own, and a job that is killed takes no other with it.
#pragma once
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace rondo::study {

/// Codes of outcomes are the program's exit codes; a job gives its own through JobReport.
enum JobCode : int {
  job_done = 0,
  job_input = 2,    ///< an InputError left the job
  job_failed = 3,   ///< numerics, or a bug: any other exception, a signal
  job_machine = 4,  ///< files or memory: FileError, bad_alloc, SIGKILL
  job_interrupted = 130,
};

/// How a job ended, as the job itself says it.
struct JobReport {
  int code = job_done;
  std::string message;     ///< of any length
  std::optional<bool> ok;  ///< counts as done for the jobs that come after; unset: code is 0
};

/// Of a job that an exception ended.
[[nodiscard]] JobReport failed_by(const std::exception& error);

/// What a job gets in its process.
class JobChannel {
 public:
  JobChannel(std::atomic<double>& share, const std::atomic<bool>& stop)
      : share_(share), stop_(stop) {}

  /// Work done so far; costs one store into memory shared with the parent.
  void progress(long long done, long long total) noexcept;

  /// Set by SIGINT, SIGTERM and SIGHUP: the job is to end cleanly, with the code job_interrupted.
  [[nodiscard]] const std::atomic<bool>* stop() const noexcept { return &stop_; }

 private:
  std::atomic<double>& share_;
  const std::atomic<bool>& stop_;
};

struct Job {
  std::string name;
  double weight = 1.0;             ///< expected cost, above 0: order and total progress
  std::vector<std::size_t> after;  ///< jobs before this one in the list that must be done first
  /// Runs in the child. Files it opens, HDF5's above all, are to be closed when it returns.
  std::function<JobReport(JobChannel&)> work;
};

enum class JobStatus { waiting, running, done, failed, interrupted };

struct JobOutcome {
  JobStatus status = JobStatus::waiting;
  int code = job_done;
  std::string message;
  double wall_s = 0.0;  ///< of the process; 0 of a job that was not started
};

/// The whole at one moment.
struct JobsProgress {
  double share = 0.0;  ///< by weight, 0 to 1; never falls; a job that is done or failed counts in
                       ///< full, one that was interrupted as far as it came
  std::size_t ended = 0;  ///< jobs
  /// Indices of jobs, in the order of their start; valid during the call.
  std::span<const std::size_t> running;
};

struct JobsOptions {
  int at_once = 0;  ///< processes; 0: available_cores()
  /// Set, usually by the caller's signal handler: the running jobs are told to stop, no other
  /// starts.
  const std::atomic<bool>* stop = nullptr;
  /// Called in the parent as each job ends, also one that was never started; may be empty.
  std::function<void(std::size_t job, const JobOutcome& outcome)> ended;
  /// Called in the parent about ten times a second, and at the end; may be empty.
  std::function<void(const JobsProgress& progress)> progress;
};

/// Cores this process may run on, at least 1.
[[nodiscard]] int available_cores();

/// Runs the jobs and returns one outcome each. What may start starts heaviest first, equal weights
/// in the order of the list. A job whose predecessor is not done fails without a start and names
/// it. A failure stops nothing else. Outcomes do not depend on at_once, times aside.
///
/// Before the call this process must not have run a parallel loop of OpenMP nor have other threads
/// at work: their pools and locks do not survive a fork, and a child that needs them hangs. (BLAS's
/// idle pool is no trouble: OpenBLAS takes it down before a fork.) The number of threads within a
/// job is the job's business, usually 1. Children stay in the process group, so that a Ctrl-C
/// reaches them all: the caller catches it and sets `stop`. They die with the thread that called.
///
/// @throws FileError if a process cannot be started, after the running ones have ended; what the
/// callbacks throw, after the running ones were told to stop and have ended.
[[nodiscard]] std::vector<JobOutcome> run_jobs(std::span<const Job> jobs,
                                               const JobsOptions& options);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/jobs.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <memory>
#include <new>
#include <thread>
#include <utility>

#include "rondo/core/contract.hpp"
#include "rondo/core/error.hpp"
#include "rondo/study/sweep/job_process.hpp"
#include "rondo/study/sweep/shared_numbers.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Between two reports of progress, and two looks at the caller's stop flag [ms].
constexpr int period_ms = 100;

class Pool {
 public:
  Pool(std::span<const Job> jobs, const JobsOptions& options);
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  std::vector<JobOutcome> run();

 private:
  [[nodiscard]] bool may_start(std::size_t job) const;
  [[nodiscard]] std::optional<std::size_t> next() const;
  void stop_if_asked();
  void refuse_waiting();
  void start_what_may();
  void wait();
  void end(std::size_t job, JobOutcome outcome);
  void report_progress();

  std::span<const Job> jobs_;
  const JobsOptions& options_;
  std::size_t at_once_;
  SharedNumbers<double> shared_;
  std::vector<double> shares_;  ///< of each job, as reported last; never fall
  std::vector<JobOutcome> outcomes_;
  std::vector<JobProcess> running_;
  bool stopping_ = false;
  std::optional<FileError> start_error_;
  Clock::time_point reported_{};
};

Pool::Pool(std::span<const Job> jobs, const JobsOptions& options)
    : jobs_(jobs),
      options_(options),
      at_once_(static_cast<std::size_t>(options.at_once > 0 ? options.at_once : available_cores())),
      shared_(jobs.size()),
      shares_(jobs.size(), 0.0),
      outcomes_(jobs.size()) {
  RONDO_DEMAND(options.at_once >= 0, options.at_once);
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    RONDO_DEMAND(std::isfinite(jobs[i].weight) && jobs[i].weight > 0.0, i, jobs[i].weight);
    for (const std::size_t before : jobs[i].after) RONDO_DEMAND(before < i, i, before);
  }
  running_.reserve(std::min(at_once_, jobs.size()));  // nothing may throw once a child is there
}

/// Children are left only if a callback threw: they are told to stop and waited for.
Pool::~Pool() {
  for (const JobProcess& process : running_) kill(process.pid, SIGTERM);
  for (const JobProcess& process : running_) static_cast<void>(finish_job(process));
}

bool Pool::may_start(std::size_t job) const {
  return outcomes_[job].status == JobStatus::waiting &&
         std::ranges::all_of(jobs_[job].after, [&](std::size_t before) {
           return outcomes_[before].status == JobStatus::done;
         });
}

std::optional<std::size_t> Pool::next() const {
  std::optional<std::size_t> best;
  for (std::size_t i = 0; i < jobs_.size(); ++i)
    if (may_start(i) && (!best || jobs_[i].weight > jobs_[*best].weight)) best = i;
  return best;
}

void Pool::stop_if_asked() {
  if (stopping_ || !options_.stop || !options_.stop->load(std::memory_order_relaxed)) return;
  stopping_ = true;
  for (const JobProcess& process : running_) kill(process.pid, SIGTERM);
}

/// Ends the jobs that will never start. One pass is enough: predecessors stand before.
void Pool::refuse_waiting() {
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    if (outcomes_[i].status != JobStatus::waiting) continue;
    const auto bad = std::ranges::find_if(jobs_[i].after, [&](std::size_t before) {
      const JobStatus status = outcomes_[before].status;
      return status == JobStatus::failed || (status == JobStatus::interrupted && !stopping_);
    });
    if (bad != jobs_[i].after.end()) {
      const bool failed = outcomes_[*bad].status == JobStatus::failed;
      end(i, {JobStatus::failed, outcomes_[*bad].code,
              fmt::format("not started: {}, which it needs, {}", jobs_[*bad].name,
                          failed ? "failed" : "was interrupted"),
              0.0});
    } else if (stopping_) {
      end(i, {JobStatus::interrupted, job_interrupted, "not started", 0.0});
    }
  }
}

void Pool::start_what_may() {
  while (running_.size() < at_once_ && !start_error_) {
    const std::optional<std::size_t> job = next();
    if (!job) return;
    try {
      running_.push_back(start_job(jobs_[*job], *job, shared_[*job]));
      outcomes_[*job].status = JobStatus::running;
    } catch (const FileError& error) {
      start_error_ = error;
    }
  }
}

/// Sleeps until a child writes or ends, at most one period.
void Pool::wait() {
  std::vector<pollfd> pipes;
  for (const JobProcess& process : running_) pipes.push_back({process.pipe, POLLIN, 0});
  if (poll(pipes.data(), pipes.size(), period_ms) < 0) {
    if (errno == EINTR) return;
    throw FileError("pipes of the running jobs", std::strerror(errno));
  }
  for (std::size_t i = pipes.size(); i-- > 0;) {
    if (pipes[i].revents == 0 || read_report(running_[i])) continue;
    const JobProcess process = std::move(running_[i]);
    running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
    end(process.job, finish_job(process));
  }
}

void Pool::end(std::size_t job, JobOutcome outcome) {
  outcomes_[job] = std::move(outcome);
  if (options_.ended) options_.ended(job, outcomes_[job]);
}

void Pool::report_progress() {
  const auto now = Clock::now();
  if (!options_.progress) return;
  if (!running_.empty() && now - reported_ < std::chrono::milliseconds(period_ms)) return;
  reported_ = now;
  JobsProgress progress;
  double done = 0.0, total = 0.0;
  for (std::size_t i = 0; i < jobs_.size(); ++i) {
    const JobStatus status = outcomes_[i].status;
    const bool over = status != JobStatus::waiting && status != JobStatus::running;
    progress.ended += over ? 1 : 0;
    const bool whole = status == JobStatus::done || status == JobStatus::failed;
    shares_[i] =
        whole ? 1.0 : std::clamp(shared_[i].load(std::memory_order_relaxed), shares_[i], 1.0);
    done += jobs_[i].weight * shares_[i];
    total += jobs_[i].weight;
  }
  progress.share = done / total;
  std::vector<std::size_t> running;
  for (const JobProcess& process : running_) running.push_back(process.job);
  progress.running = running;
  options_.progress(progress);
}

std::vector<JobOutcome> Pool::run() {
  while (true) {
    stop_if_asked();
    refuse_waiting();
    start_what_may();
    if (running_.empty()) break;
    report_progress();
    wait();
  }
  if (start_error_) throw *start_error_;
  if (!jobs_.empty()) report_progress();
  return std::move(outcomes_);
}

}  // namespace

int available_cores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return std::max(1, CPU_COUNT(&set));
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

std::vector<JobOutcome> run_jobs(std::span<const Job> jobs, const JobsOptions& options) {
  return Pool(jobs, options).run();
}

}  // namespace rondo::study

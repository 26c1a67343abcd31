// SPDX-License-Identifier: BSD-3-Clause
/// Jobs in processes: order, dependencies, bounds, outcomes, progress.
#include "rondo/study/sweep/jobs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>

#include "rondo/core/error.hpp"
#include "unit/study/jobs_fixture.hpp"

using namespace rondo;
using namespace rondo::study;

namespace {

/// Jobs in the order in which their work began.
struct Starts {
  std::atomic<std::size_t> n{0};
  std::array<std::size_t, 16> job{};
  void note(std::size_t i) { job.at(n++) = i; }
  [[nodiscard]] std::vector<std::size_t> list() const { return {job.begin(), job.begin() + n}; }
};

JobReport done(JobChannel&) {
  return {};
}

JobOutcome only(std::function<JobReport(JobChannel&)> work) {
  const std::vector<Job> jobs{make_job("only", std::move(work))};
  return run_jobs(jobs, {}).at(0);
}

}  // namespace

TEST(Jobs, NoneGiveNothing) {
  JobsOptions options;
  options.progress = [](const JobsProgress&) { ADD_FAILURE() << "nothing is under way"; };
  EXPECT_TRUE(run_jobs({}, options).empty());
}

TEST(Jobs, OutcomesDoNotDependOnHowManyRunAtOnce) {
  for (const int n : {0, 1, 2, 3, 50}) {
    std::vector<Job> jobs;
    for (int i = 0; i < 6; ++i)
      jobs.push_back(make_job("job", [i](JobChannel&) {
        return JobReport{i % 3, "message " + std::to_string(i), {}};
      }));
    jobs[5].after = {1};
    const std::vector<JobOutcome> outcomes = run_jobs(jobs, at_once(n));
    ASSERT_EQ(outcomes.size(), 6U);
    for (int i = 0; i < 5; ++i) {
      const JobOutcome& outcome = outcomes[static_cast<std::size_t>(i)];
      EXPECT_EQ(outcome.code, i % 3);
      EXPECT_EQ(outcome.message, "message " + std::to_string(i));
      EXPECT_EQ(outcome.status, i % 3 == 0 ? JobStatus::done : JobStatus::failed);
      EXPECT_GT(outcome.wall_s, 0.0);
    }
    EXPECT_EQ(outcomes[5].message, "not started: job, which it needs, failed");
  }
}

TEST(Jobs, EachHasAProcessOfItsOwnInTheGroupOfAll) {
  Shared<std::array<pid_t, 2>> pids;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < 2; ++i)
    jobs.push_back(make_job("job", [&pids, i](JobChannel&) {
      (*pids)[i] = getpid();
      return JobReport{getpgrp() == getpgid(getppid()) ? 0 : 1, {}, {}};
    }));
  for (const JobOutcome& outcome : run_jobs(jobs, {})) EXPECT_EQ(outcome.code, 0);
  EXPECT_NE((*pids)[0], (*pids)[1]);
  for (const pid_t pid : *pids) EXPECT_TRUE(pid > 0 && pid != getpid());
}

TEST(Jobs, HeaviestFirstThenInOrder) {
  Shared<Starts> starts;
  std::vector<Job> jobs;
  for (const double weight : {1.0, 5.0, 2.0, 5.0, 3.0}) {
    const std::size_t i = jobs.size();
    jobs.push_back(make_job("job", [&starts, i](JobChannel&) {
      starts->note(i);
      return JobReport{};
    }));
    jobs.back().weight = weight;
  }
  ASSERT_EQ(run_jobs(jobs, at_once(1)).size(), 5U);
  EXPECT_EQ(starts->list(), (std::vector<std::size_t>{1, 3, 4, 2, 0}));
}

TEST(Jobs, AJobStartsOnceAllItNeedsIsDone) {
  for (const int n : {1, 4}) {
    Shared<std::array<std::atomic<bool>, 3>> over;
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < 3; ++i)
      jobs.push_back(make_job("job", [&over, i](JobChannel&) {
        const bool early = i == 2 && (!(*over)[0] || !(*over)[1]);
        (*over)[i] = true;
        return JobReport{early ? 1 : 0, {}, {}};
      }));
    jobs[2].weight = 100.0;  // it would be first
    jobs[2].after = {0, 1};
    for (const JobOutcome& outcome : run_jobs(jobs, at_once(n)))
      EXPECT_EQ(outcome.status, JobStatus::done);
    EXPECT_TRUE((*over)[2]);
  }
}

TEST(Jobs, AsManyRunAsMayAndNoMore) {
  Shared<std::atomic<int>> started;
  Shared<std::atomic<bool>> seen;
  std::vector<Job> jobs(6, make_job("job", [&](JobChannel&) {
                          ++*started;  // none ends before two run and the parent has counted them
                          const bool two = holds_soon([&] { return *started >= 2 && *seen; });
                          return JobReport{two ? 0 : 1, {}, {}};
                        }));
  std::size_t most = 0;
  JobsOptions options = at_once(2);
  options.progress = [&](const JobsProgress& progress) {
    most = std::max(most, progress.running.size());
    *seen = true;
  };
  for (const JobOutcome& outcome : run_jobs(jobs, options))
    EXPECT_EQ(outcome.status, JobStatus::done);
  EXPECT_EQ(most, 2U);
}

TEST(Jobs, CoresAreAtLeastOne) {
  EXPECT_GE(available_cores(), 1);
  cpu_set_t all, one;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  EXPECT_EQ(in_process([&] {
              CPU_ZERO(&one);
              for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++i)
                if (CPU_ISSET(i, &all)) CPU_SET(i, &one);
              return sched_setaffinity(0, sizeof one, &one) == 0 ? available_cores() : 99;
            }),
            1);
}

TEST(Jobs, ExceptionsBecomeCodes) {
  Fault first, second;
  first.key = "a.b";
  first.message = "is wrong";
  second.message = "is worse";
  const JobOutcome input = only([&](JobChannel&) -> JobReport {
    throw InputError(std::vector<Fault>{first, second});
  });
  EXPECT_EQ(input.code, job_input);
  EXPECT_EQ(input.message, first.text() + "\n" + second.text());
  const JobOutcome file =
      only([](JobChannel&) -> JobReport { throw FileError("x.h5", "disk full"); });
  EXPECT_EQ(file.code, job_machine);
  EXPECT_EQ(file.message, "x.h5: disk full");
  const JobOutcome memory = only([](JobChannel&) -> JobReport { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, job_machine);
  EXPECT_EQ(memory.message, "not enough memory");
  const JobOutcome bug = only([](JobChannel&) -> JobReport { throw std::runtime_error("odd"); });
  EXPECT_EQ(bug.code, job_failed);
  EXPECT_EQ(bug.message, "unexpected failure, a bug of rondo's: odd");
  const JobOutcome other = only([](JobChannel&) -> JobReport { throw 7; });
  EXPECT_EQ(other.code, job_failed);
  EXPECT_NE(other.message.find("unknown type"), std::string::npos);
  for (const JobOutcome* outcome : {&input, &file, &memory, &bug, &other})
    EXPECT_EQ(outcome->status, JobStatus::failed);
}

TEST(Jobs, AKilledJobTakesNoOtherWithIt) {
  const std::vector<Job> jobs{make_job("killed",
                                       [](JobChannel&) {
                                         raise(SIGKILL);
                                         return JobReport{};
                                       }),
                              make_job("aborted",
                                       [](JobChannel&) {
                                         raise(SIGUSR1);
                                         return JobReport{};
                                       }),
                              make_job("left", [](JobChannel&) -> JobReport { std::_Exit(5); }),
                              make_job("well", done)};
  const std::vector<JobOutcome> outcomes = run_jobs(jobs, at_once(2));
  EXPECT_EQ(outcomes[0].code, job_machine);
  EXPECT_EQ(outcomes[0].message,
            "killed by signal 9 (Killed); the usual reason is that memory ran out");
  EXPECT_EQ(outcomes[1].code, job_failed);
  EXPECT_EQ(outcomes[1].message, "killed by signal 10 (User defined signal 1)");
  EXPECT_EQ(outcomes[2].code, job_failed);
  EXPECT_EQ(outcomes[2].message, "its process ended without a report, with exit code 5");
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(outcomes[i].status, JobStatus::failed);
  EXPECT_EQ(outcomes[3].status, JobStatus::done);
}

TEST(Jobs, MessagesOfAnyLength) {
  std::vector<Job> jobs;
  for (const char c : {'a', 'b', 'c'})
    jobs.push_back(make_job("job", [c](JobChannel&) {
      return JobReport{0, std::string(1 << 20, c) + "\n", {}};
    }));
  const std::vector<JobOutcome> outcomes = run_jobs(jobs, at_once(3));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(outcomes[i].status, JobStatus::done);
    EXPECT_TRUE(outcomes[i].message == std::string(1 << 20, "abc"[i]) + "\n");
  }
}

TEST(Jobs, AFailureStopsWhatNeedsItAndNothingElse) {
  Shared<Starts> starts;
  const auto ends_with = [&starts](std::size_t i, const JobReport& report) {
    return [&starts, i, report](JobChannel&) {
      starts->note(i);
      return report;
    };
  };
  std::vector<Job> jobs{make_job("run", ends_with(0, {3, "blew up", {}})),
                        make_job("pod", ends_with(1, {})),
                        make_job("other", ends_with(2, {3, "as it should", true})),
                        make_job("figure", ends_with(3, {})),
                        make_job("other-pod", ends_with(4, {0, "bad all the same", false})),
                        make_job("broken", ends_with(5, {job_interrupted, "", {}})),
                        make_job("broken-pod", ends_with(6, {}))};
  jobs[1].after = {0};
  jobs[3].after = {2, 1};
  jobs[4].after = {2};
  jobs[6].after = {5};
  std::vector<std::size_t> ended;
  JobsOptions options = at_once(1);
  options.ended = [&](std::size_t job, const JobOutcome&) { ended.push_back(job); };
  const std::vector<JobOutcome> outcomes = run_jobs(jobs, options);
  EXPECT_EQ(starts->list(), (std::vector<std::size_t>{0, 2, 4, 5}));
  EXPECT_EQ(ended, (std::vector<std::size_t>{0, 1, 3, 2, 4, 5, 6}));
  EXPECT_EQ(outcomes[0].message, "blew up");
  EXPECT_EQ(outcomes[1].message, "not started: run, which it needs, failed");
  EXPECT_EQ(outcomes[3].message, "not started: pod, which it needs, failed");
  EXPECT_EQ(outcomes[6].message, "not started: broken, which it needs, was interrupted");
  for (const std::size_t i : {0U, 1U, 3U, 4U, 6U})
    EXPECT_EQ(outcomes[i].status, JobStatus::failed) << i;
  for (const std::size_t i : {1U, 3U}) EXPECT_EQ(outcomes[i].code, 3) << i;
  EXPECT_EQ(outcomes[2].status, JobStatus::done);
  EXPECT_EQ(outcomes[2].code, 3);
  EXPECT_EQ(outcomes[5].status, JobStatus::interrupted);
}

TEST(Jobs, NothingToDoYetIsNoShare) {
  std::atomic<double> share{0.0};
  const std::atomic<bool> stop{false};
  JobChannel channel(share, stop);
  channel.progress(0, 0);
  EXPECT_EQ(share, 0.0);
  channel.progress(3, 4);
  EXPECT_EQ(share, 0.75);
}

TEST(Jobs, ProgressRisesToOne) {
  // Of each job: 1 it is half done, 2 the parent has seen it, 3 it has gone back, 4 and 5 the
  // parent has called twice since (the share of the first call may have been read before).
  Shared<std::array<std::atomic<int>, 2>> stage;
  std::vector<Job> jobs;
  for (std::size_t i = 0; i < 2; ++i)
    jobs.push_back(make_job("job", [&stage, i](JobChannel& channel) {
      std::atomic<int>& mine = (*stage)[i];
      channel.progress(1, 2);
      mine = 1;
      const bool seen = holds_soon([&] { return mine == 2; });
      channel.progress(1, 5);
      mine = 3;
      return JobReport{seen && holds_soon([&] { return mine == 5; }) ? 0 : 1, {}, {}};
    }));
  jobs[1].weight = 3.0;
  jobs.push_back(make_job("fails", [](JobChannel&) { return JobReport{1, {}, {}}; }));
  jobs.back().weight = 4.0;
  std::vector<double> shares;
  JobsOptions options = at_once(1);  // weights 4, 3, 1 one after the other
  options.progress = [&](const JobsProgress& progress) {
    shares.push_back(progress.share);
    EXPECT_EQ(progress.running.size(), progress.ended < 3 ? 1U : 0U);
    if (progress.running.empty() || progress.running[0] > 1) return;
    const std::size_t i = progress.running[0];
    EXPECT_EQ(progress.ended, i == 1 ? 1U : 2U);
    std::atomic<int>& its = (*stage)[i];
    const bool half = progress.share == (i == 1 ? 5.5 / 8.0 : 7.5 / 8.0);
    if ((its == 1 && half) || its == 3 || its == 4) ++its;
  };
  const std::vector<JobOutcome> outcomes = run_jobs(jobs, options);
  EXPECT_EQ(outcomes[0].status, JobStatus::done);
  EXPECT_EQ(outcomes[1].status, JobStatus::done);
  EXPECT_TRUE(std::ranges::is_sorted(shares));
  EXPECT_EQ(shares.back(), 1.0);
  EXPECT_GE(shares.front(), 0.0);
}

TEST(Jobs, NoChildAndNoOpenFileIsLeft) {
  const std::ptrdiff_t before = open_files();
  std::vector<Job> jobs(5, make_job("job", done));
  jobs[2].work = [](JobChannel&) {
    raise(SIGKILL);
    return JobReport{};
  };
  ASSERT_EQ(run_jobs(jobs, at_once(3)).size(), 5U);
  EXPECT_EQ(open_files(), before);
  EXPECT_TRUE(no_child_left());
}

TEST(JobsDeathTest, WhatCannotBeOrderedIsABug) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // BLAS may keep threads
  std::vector<Job> jobs(2, make_job("job", done));
  jobs[0].after = {1};
  EXPECT_DEATH(static_cast<void>(run_jobs(jobs, {})), "broken contract `before < i`");
  jobs[0].after = {};
  jobs[1].weight = 0.0;
  EXPECT_DEATH(static_cast<void>(run_jobs(jobs, {})), "weight > 0");
}

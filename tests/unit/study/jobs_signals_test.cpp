// SPDX-License-Identifier: BSD-3-Clause
/// Jobs in processes: signals, stops, the parent's death, processes that cannot be started, what
/// parent and child share. Tests that change the process run in one of their own.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "rondo/core/error.hpp"
#include "unit/study/jobs_fixture.hpp"

using namespace rondo;
using namespace rondo::study;

namespace {

/// Ends once told to stop, then with this report.
std::function<JobReport(JobChannel&)> stopped_with(std::atomic<bool>& started, JobReport report) {
  return [&started, report = std::move(report)](JobChannel& channel) {
    started = true;
    return wait_for_stop(channel) ? report : JobReport{1, "was not told to stop", {}};
  };
}

/// 'S' while it sleeps, as in a write to a full pipe; 'R' while it runs.
char state_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string text(std::istreambuf_iterator<char>(in), {});
  return text.at(text.rfind(')') + 2);
}

/// Of a job whose long report nobody reads until it has got this signal.
JobOutcome signalled_amid_its_report(int number) {
  Shared<std::atomic<pid_t>> child;
  const std::vector<Job> jobs{make_job("job", [&](JobChannel&) {
    JobReport report{0, std::string(1 << 20, 'a'), {}};
    *child = getpid();
    return report;
  })};
  JobsOptions options;
  bool sent = false;
  options.progress = [&](const JobsProgress&) {  // meanwhile nobody reads the pipe
    if (std::exchange(sent, true)) return;
    ASSERT_TRUE(holds_soon([&] { return *child != 0 && state_of(*child) == 'S'; }));
    kill(*child, number);
    if (number == SIGTERM) holds_soon([&] { return state_of(*child) == 'S'; });
  };
  return run_jobs(jobs, options)[0];
}

}  // namespace

TEST(JobsStop, RunningJobsEndCleanlyAndNoOtherStarts) {
  Shared<std::array<std::atomic<bool>, 4>> started;
  std::vector<Job> jobs{
      make_job("a", stopped_with((*started)[0], {job_interrupted, std::string(1 << 20, 'a'), {}})),
      make_job("b", stopped_with((*started)[1], {0, "was through", {}})),
      make_job("c", stopped_with((*started)[2], {})),
      make_job("d", stopped_with((*started)[3], {}))};
  jobs[3].after = {0};
  std::atomic<bool> stop{false};
  std::vector<std::size_t> ended;
  JobsOptions options = at_once(2);
  options.stop = &stop;
  options.progress = [&](const JobsProgress&) { stop = (*started)[0] && (*started)[1]; };
  options.ended = [&](std::size_t job, const JobOutcome&) { ended.push_back(job); };
  const std::vector<JobOutcome> outcomes = run_jobs(jobs, options);
  EXPECT_EQ(outcomes[0].status, JobStatus::interrupted);
  EXPECT_TRUE(outcomes[0].message == std::string(1 << 20, 'a'));
  EXPECT_EQ(outcomes[1].status, JobStatus::done);
  EXPECT_EQ(outcomes[1].message, "was through");
  for (const std::size_t i : {2U, 3U}) {
    EXPECT_EQ(outcomes[i].status, JobStatus::interrupted);
    EXPECT_EQ(outcomes[i].code, job_interrupted);
    EXPECT_EQ(outcomes[i].message, "not started");
    EXPECT_FALSE((*started)[i]);
  }
  EXPECT_EQ(ended.size(), 4U);
}

TEST(JobsStop, SetBeforehandStartsNothing) {
  Shared<std::atomic<bool>> started;
  const std::vector<Job> jobs{make_job("a", stopped_with(*started, {}))};
  const std::atomic<bool> stop{true};
  JobsOptions options;
  options.stop = &stop;
  EXPECT_EQ(run_jobs(jobs, options)[0].status, JobStatus::interrupted);
  EXPECT_FALSE(*started);
}

TEST(JobsStop, EachOfTheSignalsReachesTheJobAndNotTheParent) {
  std::vector<Job> jobs;
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, SIG_DFL);  // but for nohup
  for (const int number : {SIGINT, SIGTERM, SIGHUP})
    jobs.push_back(make_job("job", [number](JobChannel& channel) {
      const bool before = channel.stop()->load();
      raise(number);
      return JobReport{before || !channel.stop()->load() ? 1 : 0, {}, {}};
    }));
  for (const JobOutcome& outcome : run_jobs(jobs, {})) EXPECT_EQ(outcome.status, JobStatus::done);
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    EXPECT_EQ(action.sa_handler, SIG_DFL);
  }
  sigset_t blocked;
  pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  EXPECT_EQ(sigismember(&blocked, SIGTERM), 0);
}

TEST(JobsStop, WhatTheParentIgnoresStaysIgnoredButForTheStopItself) {
  EXPECT_EQ(in_process([] {
              std::signal(SIGHUP, SIG_IGN);
              std::signal(SIGTERM, SIG_IGN);
              const std::vector<Job> jobs{make_job("job", [](JobChannel& channel) {
                raise(SIGHUP);
                if (channel.stop()->load()) return JobReport{1, {}, {}};
                raise(SIGTERM);
                return JobReport{channel.stop()->load() ? 0 : 2, {}, {}};
              })};
              return run_jobs(jobs, {})[0].code;
            }),
            0);
}

TEST(JobsStop, OfAJobIsNotThatOfTheJobsWithinIt) {
  const std::vector<Job> jobs{make_job("outer", [](JobChannel&) {
    raise(SIGTERM);
    const std::vector<Job> inner{make_job("inner", [](JobChannel& channel) {
      return JobReport{channel.stop()->load() ? 1 : 0, {}, {}};
    })};
    return JobReport{run_jobs(inner, {})[0].code, {}, {}};
  })};
  EXPECT_EQ(run_jobs(jobs, {})[0].code, 0);
}

TEST(JobsProcess, HalfAReportIsNone) {
  const JobOutcome outcome = signalled_amid_its_report(SIGKILL);
  EXPECT_EQ(outcome.status, JobStatus::failed);
  EXPECT_EQ(outcome.message.substr(0, 18), "killed by signal 9");
}

TEST(JobsProcess, AStopAmidAReportCutsNothing) {
  const JobOutcome outcome = signalled_amid_its_report(SIGTERM);
  EXPECT_EQ(outcome.status, JobStatus::done);
  EXPECT_TRUE(outcome.message == std::string(1 << 20, 'a')) << outcome.message.substr(0, 80);
}

/// As after a Ctrl-C: the parent sleeps, its handler sets the stop flag, the job is told.
TEST(JobsStop, ASignalToTheParentStopsTheJobs) {
  EXPECT_EQ(in_process([] {
              static std::atomic<bool> stop{false};
              std::signal(SIGINT, [](int) { stop = true; });
              const std::vector<Job> jobs{make_job("job", [](JobChannel& channel) {
                const bool asleep = holds_soon([] { return state_of(getppid()) == 'S'; });
                kill(getppid(), SIGINT);
                return JobReport{asleep && wait_for_stop(channel) ? 7 : 1, {}, {}};
              })};
              JobsOptions options;
              options.stop = &stop;
              try {
                return run_jobs(jobs, options)[0].code;
              } catch (const std::exception&) {
                return 2;
              }
            }),
            7);
}

TEST(JobsProcess, DiesWithItsParent) {
  std::array<int, 2> ends{};  // nobody writes: it reaches its end as the last holder dies
  ASSERT_EQ(pipe(ends.data()), 0);
  Shared<std::atomic<pid_t>> child;
  const pid_t parent = fork();
  if (parent == 0) {
    const std::vector<Job> jobs{make_job("endless", [&](JobChannel&) -> JobReport {
      *child = getpid();
      while (true) pause();
    })};
    _exit(static_cast<int>(run_jobs(jobs, {}).size()));
  }
  close(ends[1]);
  ASSERT_TRUE(holds_soon([&] { return *child != 0; }));
  kill(parent, SIGKILL);
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  pollfd end{ends[0], POLLIN, 0};
  EXPECT_EQ(poll(&end, 1, 30000), 1) << "the child lives on";
  if (end.revents == 0) kill(*child, SIGKILL);
  close(ends[0]);
}

TEST(JobsProcess, WhatTheParentHasBufferedIsWrittenOnceAndItsExitHandlersRunOnce) {
  const auto file =
      std::filesystem::temp_directory_path() / ("rondo-jobs-" + std::to_string(getpid()));
  static Shared<std::atomic<int>> exits;
  *exits = 0;
  in_process([&]() -> int {
    if (!std::freopen(file.c_str(), "w", stdout)) return 1;
    std::atexit([] { ++*exits; });
    std::printf("before\n");
    const std::vector<Job> jobs{make_job("job", [](JobChannel&) {
      std::printf("job\n");
      return JobReport{};
    })};
    static_cast<void>(run_jobs(jobs, {}));
    std::printf("after\n");
    std::exit(0);
  });
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, "before\njob\nafter\n");
  EXPECT_EQ(*exits, 1);
  std::filesystem::remove(file);
}

TEST(JobsProcess, IgnoredSigchldLosesNoOutcome) {
  EXPECT_EQ(in_process([] {
              std::signal(SIGCHLD, SIG_IGN);
              std::vector<Job> jobs(3, make_job("job", [](JobChannel&) {
                                      return JobReport{7, "text", {}};
                                    }));
              jobs[1].work = [](JobChannel&) -> JobReport { std::_Exit(0); };
              const std::vector<JobOutcome> outcomes = run_jobs(jobs, at_once(2));
              const bool well = outcomes[0].code == 7 && outcomes[2].message == "text" &&
                                outcomes[1].message == "its process ended without a report";
              return well ? 0 : 1;
            }),
            0);
}

TEST(JobsProcess, NoPipeIsAnErrorThatSaysWhatToDo) {
  EXPECT_EQ(in_process([] {
              const rlim_t open = static_cast<rlim_t>(open_files());
              const rlimit few{open - 1, open};  // one is the directory that counted them
              if (setrlimit(RLIMIT_NOFILE, &few) != 0) return 2;
              const std::vector<Job> jobs(2,
                                          make_job("x", [](JobChannel&) { return JobReport{}; }));
              try {
                static_cast<void>(run_jobs(jobs, {}));
              } catch (const FileError& error) {
                const std::string text = error.what();
                return text.find("job x") == 0 && text.find("ulimit -n") != text.npos ? 0 : 1;
              }
              return 3;
            }),
            0);
}

/// The second of two jobs ends and the third cannot be forked: the first is waited for.
TEST(JobsProcess, NoForkIsAnErrorOnceTheRunningOnesHaveEnded) {
  Shared<std::atomic<bool>> go, first_ended;
  EXPECT_EQ(
      in_process([&] {
        if (geteuid() == 0 && setresuid(65534, 65534, 65534) != 0) return 2;  // root has no limit
        const std::vector<Job> jobs{
            make_job("first",
                     [&](JobChannel&) {
                       return JobReport{holds_soon([&] { return go->load(); }) ? 0 : 1, {}, {}};
                     }),
            make_job("second", [](JobChannel&) { return JobReport{}; }),
            make_job("third", [](JobChannel&) { return JobReport{}; })};
        JobsOptions options = at_once(2);
        options.ended = [&](std::size_t job, const JobOutcome& outcome) {
          const rlimit none{0, 0};
          setrlimit(RLIMIT_NPROC, &none);
          if (job == 0) *first_ended = outcome.status == JobStatus::done;
        };
        options.progress = [&](const JobsProgress& progress) { *go = progress.ended == 1; };
        const std::ptrdiff_t before = open_files();
        try {
          static_cast<void>(run_jobs(jobs, options));
        } catch (const FileError& error) {
          if (std::string(error.what()).find("job third") != 0) return 3;
          return no_child_left() && open_files() == before ? 0 : 4;
        }
        return 5;
      }),
      0);
  EXPECT_TRUE(*first_ended);
}

TEST(JobsProcess, ACallbackThatThrowsLeavesNothingBehind) {
  const std::ptrdiff_t before = open_files();
  Shared<std::atomic<int>> started, stopped;
  const std::vector<Job> jobs(2, make_job("job", [&](JobChannel& channel) {
                                ++*started;
                                if (wait_for_stop(channel)) ++*stopped;
                                return JobReport{};
                              }));
  JobsOptions options = at_once(2);
  options.progress = [&](const JobsProgress&) {
    if (*started == 2) throw std::runtime_error("the callback's");
  };
  EXPECT_THROW(static_cast<void>(run_jobs(jobs, options)), std::runtime_error);
  EXPECT_EQ(*stopped, 2);
  EXPECT_TRUE(no_child_left());
  EXPECT_EQ(open_files(), before);
}

// SPDX-License-Identifier: BSD-3-Clause
/// Workers in processes: outcomes, signals, stops, the parent's death, processes that cannot be
/// started. Tests that change the process run in one of their own.
#include "rondo/study/sweep/worker_processes.hpp"

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
#include "rondo/study/sweep/shared_numbers.hpp"
#include "unit/study/processes.hpp"

namespace worker_processes_test {

using namespace rondo;
using namespace rondo::study;

namespace {

using Stop = std::atomic<bool>;

/// 'S' while it sleeps, as in a write to a full pipe; 'R' while it runs.
char state_of(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string text(std::istreambuf_iterator<char>(in), {});
  return text.at(text.rfind(')') + 2);
}

/// So that this many can still be opened.
bool limit_open_files(int more) {
  std::vector<int> next;
  for (int k = 0; k < more; ++k) next.push_back(dup(STDIN_FILENO));
  for (const int descriptor : next) close(descriptor);
  const auto limit = static_cast<rlim_t>(next.back()) + 1;
  const rlimit few{limit, limit};
  return setrlimit(RLIMIT_NOFILE, &few) == 0;
}

WorkerOutcome only(const WorkerTask& task) {
  return run_workers(1, task, nullptr, {}).at(0);
}

/// Of a worker whose long text nobody reads until it has got this signal.
WorkerOutcome signalled_amid_its_report(int number) {
  SharedNumbers<pid_t> child(1);
  bool sent = false;
  const auto watch = [&] {  // meanwhile nobody reads the pipe
    if (sent || child[0] == 0) return;
    sent = true;
    ASSERT_TRUE(holds_soon([&] { return state_of(child[0]) == 'S'; }));
    kill(child[0], number);
  };
  return run_workers(
      1,
      [&](int, const Stop&) {
        std::string text(1 << 22, 'a');
        child[0] = getpid();
        return text;
      },
      nullptr, watch)[0];
}

}  // namespace

TEST(Workers, EachHasAProcessOfItsOwnAndATextOfAnyLength) {
  SharedNumbers<pid_t> pids(3);
  const auto outcomes = run_workers(3,
                                    [&](int w, const Stop&) {
                                      pids[static_cast<std::size_t>(w)] =
                                          getpgrp() == getpgid(getppid()) ? getpid() : 0;
                                      return std::string(1 << 20, static_cast<char>('a' + w));
                                    },
                                    nullptr, {});
  ASSERT_EQ(outcomes.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(outcomes[k].code, exit_done);
    EXPECT_TRUE(outcomes[k].text == std::string(1 << 20, "abc"[k]));
    EXPECT_TRUE(pids[k] > 0 && pids[k] != getpid() && pids[k] != pids[(k + 1) % 3]);
  }
  EXPECT_TRUE(run_workers(0, {}, nullptr, {}).empty());
}

TEST(Workers, ExceptionsBecomeCodes) {
  const WorkerOutcome input =
      only([](int, const Stop&) -> std::string { throw InputError(Fault{}); });
  EXPECT_EQ(input.code, exit_input);
  const WorkerOutcome file =
      only([](int, const Stop&) -> std::string { throw FileError("x.h5", "disk full"); });
  EXPECT_EQ(file.code, exit_files);
  EXPECT_EQ(file.text, "x.h5: disk full");
  const WorkerOutcome memory =
      only([](int, const Stop&) -> std::string { throw std::bad_alloc(); });
  EXPECT_EQ(memory.code, exit_files);
  EXPECT_EQ(memory.text, "not enough memory");
  const WorkerOutcome bug =
      only([](int, const Stop&) -> std::string { throw std::runtime_error("odd"); });
  EXPECT_EQ(bug.code, exit_numerical);
  EXPECT_EQ(bug.text, "unexpected failure, a bug of rondo's: odd");
  const WorkerOutcome other = only([](int, const Stop&) -> std::string { throw 7; });
  EXPECT_EQ(other.code, exit_numerical);
  EXPECT_NE(other.text.find("unknown type"), std::string::npos);
}

TEST(Workers, AKilledOneTakesNoOtherWithItAndNothingIsLeft) {
  const std::ptrdiff_t before = open_files();
  const auto outcomes = run_workers(4,
                                    [](int w, const Stop&) -> std::string {
                                      if (w == 0) raise(SIGKILL);
                                      if (w == 1) raise(SIGUSR1);
                                      if (w == 2) std::_Exit(5);
                                      return "well";
                                    },
                                    nullptr, {});
  EXPECT_EQ(outcomes[0].code, exit_files);
  EXPECT_EQ(outcomes[0].text,
            "killed by signal 9 (Killed); the usual reason is that memory ran out");
  EXPECT_EQ(outcomes[1].code, exit_numerical);
  EXPECT_EQ(outcomes[1].text, "killed by signal 10 (User defined signal 1)");
  EXPECT_EQ(outcomes[2].code, exit_numerical);
  EXPECT_EQ(outcomes[2].text, "its process ended without a report, with exit code 5");
  EXPECT_EQ(outcomes[3].code, exit_done);
  EXPECT_EQ(outcomes[3].text, "well");
  EXPECT_EQ(open_files(), before);
  EXPECT_TRUE(no_child_left());
}

TEST(WorkersStop, EachOfTheSignalsReachesTheWorkerAndNotTheParent) {
  const std::array<int, 3> signals{SIGINT, SIGTERM, SIGHUP};
  for (const int number : signals) std::signal(number, SIG_DFL);  // but for nohup
  const auto outcomes = run_workers(3,
                                    [&](int w, const Stop& stop) -> std::string {
                                      const bool before = stop.load();
                                      raise(signals.at(static_cast<std::size_t>(w)));
                                      return before || !stop.load() ? "not told" : "told";
                                    },
                                    nullptr, {});
  for (const WorkerOutcome& outcome : outcomes) EXPECT_EQ(outcome.text, "told");
  for (const int number : signals) {
    struct sigaction action {};
    sigaction(number, nullptr, &action);
    EXPECT_EQ(action.sa_handler, SIG_DFL);
  }
  sigset_t blocked;
  pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  EXPECT_EQ(sigismember(&blocked, SIGTERM), 0);
}

TEST(WorkersStop, WhatTheParentIgnoresStaysIgnoredButForTheStopItself) {
  EXPECT_EQ(in_process([] {
              std::signal(SIGHUP, SIG_IGN);
              std::signal(SIGTERM, SIG_IGN);
              const WorkerOutcome outcome = only([](int, const Stop& stop) -> std::string {
                raise(SIGHUP);
                if (stop.load()) return "too early";
                raise(SIGTERM);
                return stop.load() ? "told" : "never";
              });
              return outcome.text == "told" ? 0 : 1;
            }),
            0);
}

/// As after a Ctrl-C: the parent sleeps, its handler sets the stop flag, the worker is told.
TEST(WorkersStop, ASignalToTheParentStopsTheWorkers) {
  EXPECT_EQ(in_process([] {
              static std::atomic<bool> stop{false};
              std::signal(SIGINT, [](int) { stop = true; });
              const auto outcomes = run_workers(
                  1,
                  [](int, const Stop& told) -> std::string {
                    const bool asleep = holds_soon([] { return state_of(getppid()) == 'S'; });
                    kill(getppid(), SIGINT);
                    return asleep && holds_soon([&] { return told.load(); }) ? "told" : "not told";
                  },
                  &stop, {});
              return outcomes[0].text == "told" ? 7 : 1;
            }),
            7);
}

TEST(Workers, HalfAReportIsNone) {
  const WorkerOutcome outcome = signalled_amid_its_report(SIGKILL);
  EXPECT_EQ(outcome.code, exit_files);
  EXPECT_EQ(outcome.text.substr(0, 18), "killed by signal 9");
}

TEST(Workers, AStopAmidAReportCutsNothing) {
  const WorkerOutcome outcome = signalled_amid_its_report(SIGTERM);
  EXPECT_EQ(outcome.code, exit_done);
  EXPECT_TRUE(outcome.text == std::string(1 << 22, 'a')) << outcome.text.substr(0, 80);
}

TEST(Workers, DieWithTheirParent) {
  std::array<int, 2> ends{};  // nobody writes: it reaches its end as the last holder dies
  ASSERT_EQ(pipe(ends.data()), 0);
  SharedNumbers<pid_t> child(1);
  const pid_t parent = fork();
  if (parent == 0) {
    const auto outcomes = run_workers(1,
                                      [&](int, const Stop&) -> std::string {
                                        child[0] = getpid();
                                        while (true) pause();
                                      },
                                      nullptr, {});
    _exit(static_cast<int>(outcomes.size()));
  }
  close(ends[1]);
  ASSERT_TRUE(holds_soon([&] { return child[0] != 0; }));
  kill(parent, SIGKILL);
  ASSERT_EQ(waitpid(parent, nullptr, 0), parent);
  pollfd end{ends[0], POLLIN, 0};
  EXPECT_EQ(poll(&end, 1, 30000), 1) << "the child lives on";
  if (end.revents == 0) kill(child[0], SIGKILL);
  close(ends[0]);
}

TEST(Workers, WhatTheParentHasBufferedIsWrittenOnceAndItsExitHandlersRunOnce) {
  const auto file =
      std::filesystem::temp_directory_path() / ("rondo-workers-" + std::to_string(getpid()));
  static SharedNumbers<int> exits(1);
  in_process([&]() -> int {
    if (!std::freopen(file.c_str(), "w", stdout)) return 1;
    std::atexit([] { ++exits[0]; });
    std::printf("before\n");
    static_cast<void>(only([](int, const Stop&) -> std::string {
      std::printf("worker\n");
      return "";
    }));
    std::printf("after\n");
    std::exit(0);
  });
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  EXPECT_EQ(text, "before\nworker\nafter\n");
  EXPECT_EQ(exits[0], 1);
  std::filesystem::remove(file);
}

TEST(Workers, IgnoredSigchldLosesNoOutcome) {
  EXPECT_EQ(in_process([] {
              std::signal(SIGCHLD, SIG_IGN);
              const auto outcomes = run_workers(2,
                                                [](int w, const Stop&) -> std::string {
                                                  if (w == 1) std::_Exit(0);
                                                  return "text";
                                                },
                                                nullptr, {});
              const bool well = outcomes[0].text == "text" &&
                                outcomes[1].text == "its process ended without a report";
              return well ? 0 : 1;
            }),
            0);
}

TEST(Workers, NoPipeIsAnErrorThatSaysWhatToDo) {
  EXPECT_EQ(in_process([] {
              if (!limit_open_files(1)) return 2;
              try {
                static_cast<void>(only([](int, const Stop&) { return std::string(); }));
              } catch (const FileError& error) {
                const std::string text = error.what();
                return text.find("worker 1") == 0 && text.find("ulimit -n") != text.npos ? 0 : 1;
              }
              return 3;
            }),
            0);
}

/// The first runs and the second has no pipe: the first is told and waited for.
TEST(Workers, OneThatCannotStartStopsThoseThatRun) {
  EXPECT_EQ(in_process([] {
              SharedNumbers<int> told(1);
              if (!limit_open_files(2)) return 2;  // a pipe, of which one end stays
              try {
                static_cast<void>(run_workers(3,
                                              [&](int, const Stop& stop) {
                                                if (holds_soon([&] { return stop.load(); }))
                                                  told[0]++;
                                                return std::string();
                                              },
                                              nullptr, {}));
              } catch (const FileError&) {
                return told[0] >= 1 && no_child_left() ? 0 : 4;
              }
              return 3;
            }),
            0);
}

TEST(Workers, AWatchThatThrowsLeavesNothingBehind) {
  const std::ptrdiff_t before = open_files();
  SharedNumbers<int> started(1), stopped(1);
  const auto watch = [&] {
    if (started[0] == 2) throw std::runtime_error("the watch's");
  };
  EXPECT_THROW(static_cast<void>(run_workers(
                   2,
                   [&](int, const Stop& stop) {
                     ++started[0];
                     if (holds_soon([&] { return stop.load(); })) ++stopped[0];
                     return std::string();
                   },
                   nullptr, watch)),
               std::runtime_error);
  EXPECT_EQ(stopped[0], 2);
  EXPECT_TRUE(no_child_left());
  EXPECT_EQ(open_files(), before);
}

}  // namespace worker_processes_test

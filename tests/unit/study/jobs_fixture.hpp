// SPDX-License-Identifier: BSD-3-Clause
/// What the tests of jobs share: memory between processes, processes of their own, waiting for a
/// condition. Waits have a limit that only a test about to fail reaches.
#pragma once
#include <sched.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <new>

#include "rondo/study/sweep/jobs.hpp"

namespace rondo::study {

/// A value that all processes forked later see; T holds atomics or plain numbers.
template <class T>
class Shared {
 public:
  Shared() {
    void* memory =
        mmap(nullptr, sizeof(T), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    value_ = new (memory) T{};
  }
  ~Shared() { munmap(value_, sizeof(T)); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;
  T& operator*() { return *value_; }
  T* operator->() { return value_; }

 private:
  T* value_;
};

/// True once the condition holds; false after half a minute.
inline bool holds_soon(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    sched_yield();
  }
  return true;
}

inline bool wait_for_stop(JobChannel& channel) {
  return holds_soon([&] { return channel.stop()->load(); });
}

/// Exit code of a process that runs `body`, minus the signal's number if a signal ended it.
inline int in_process(const std::function<int()>& body) {
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) _exit(body());
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

inline Job make_job(std::string name, std::function<JobReport(JobChannel&)> work) {
  Job job;
  job.name = std::move(name);
  job.work = std::move(work);
  return job;
}

inline JobsOptions at_once(int n) {
  JobsOptions options;
  options.at_once = n;
  return options;
}

inline bool no_child_left() {
  return waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD;
}

inline std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// What tests with processes share: processes of their own, waiting for a condition. Waits have a
/// limit that only a test about to fail reaches.
#pragma once
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace rondo::study {

/// True once the condition holds; false after half a minute.
inline bool holds_soon(const std::function<bool()>& condition) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > limit) return false;
    sched_yield();
  }
  return true;
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

inline bool no_child_left() {
  return waitpid(-1, nullptr, WNOHANG) < 0 && errno == ECHILD;
}

inline std::ptrdiff_t open_files() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {});
}

}  // namespace rondo::study

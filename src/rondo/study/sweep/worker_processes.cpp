// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/worker_processes.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>

namespace rondo::study {
namespace {

/// Time between calls of `watch`, and between checks of the caller's stop flag [ms].
constexpr int period_ms = 100;

/// Precedes the text in the pipe.
struct MessageHeader {
  std::uint64_t length = 0;
  std::int64_t code = 0;
};

// In the child --------------------------------------------------------------------------------

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_worker_stop(int) {
  stop_requested.store(true);
}

constexpr std::array<int, 3> stop_signals{SIGINT, SIGTERM, SIGHUP};

sigset_t stop_set() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : stop_signals) sigaddset(&set, number);
  return set;
}

/// Signals that the parent ignores remain ignored (nohup, the shell's background jobs), except
/// SIGTERM, by which the parent itself tells a worker to stop.
void catch_stop_signals() {
  stop_requested.store(false);
  struct sigaction action {};
  action.sa_handler = request_worker_stop;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  for (const int number : stop_signals) {
    struct sigaction before {};
    sigaction(number, nullptr, &before);
    if (number == SIGTERM || before.sa_handler != SIG_IGN) sigaction(number, &action, nullptr);
  }
  const sigset_t set = stop_set();
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

WorkerOutcome work_guarded(const WorkerTask& task, int worker) {
  try {
    return {exit_done, task(worker, stop_requested)};
  } catch (const std::exception& error) {
    return failed_by(error);
  } catch (...) {
    return {exit_numerical, "unexpected failure, a bug of rondo's: an exception of unknown type"};
  }
}

bool write_all(int file, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = write(file, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

/// noexcept: an exception that escapes nevertheless aborts this process, and the parent sees it.
[[noreturn]] void be_child(const WorkerTask& task, int worker, int pipe, pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before prctl took effect
  catch_stop_signals();
  const WorkerOutcome outcome = work_guarded(task, worker);
  std::fflush(nullptr);
  const MessageHeader header{outcome.text.size(), outcome.code};
  const bool sent = write_all(pipe, &header, sizeof header) &&
                    write_all(pipe, outcome.text.data(), outcome.text.size());
  _exit(sent ? 0 : 1);  // no destructors, no atexit handlers: they are the parent's
}

// In the parent -------------------------------------------------------------------------------

struct Process {
  pid_t pid = -1;
  int pipe = -1;         ///< read end; -1: the child has ended
  std::string received;  ///< text so far
};

FileError cannot_start(int worker, int error) {
  return {fmt::format("worker {}", worker + 1),
          fmt::format("its process cannot be started: {}; allow more processes and open files "
                      "(ulimit -u, ulimit -n) or run fewer at once",
                      std::strerror(error))};
}

Process start(const WorkerTask& task, int worker) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw cannot_start(worker, errno);
  std::fflush(nullptr);  // else the child would write buffered output again
  const pid_t parent = getpid();
  const sigset_t stops = stop_set();
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &stops, &before);  // until the child has its own handlers
  const pid_t pid = fork();
  if (pid == 0) {
    close(ends[0]);
    be_child(task, worker, ends[1], parent);
  }
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(ends[1]);
  if (pid > 0) return {pid, ends[0], {}};
  close(ends[0]);
  throw cannot_start(worker, error);
}

/// Reads from the pipe, waiting if it is empty. Returns false at its end: the child has ended.
bool receive(Process& process) {
  std::array<char, 65536> buffer;
  ssize_t size = 0;
  do size = ::read(process.pipe, buffer.data(), buffer.size());
  while (size < 0 && errno == EINTR);
  if (size > 0) process.received.append(buffer.data(), static_cast<std::size_t>(size));
  return size > 0;
}

/// Closes the pipe and waits for the end. None if the system does not keep the status (the parent
/// ignores SIGCHLD).
std::optional<int> finish(Process& process) {
  close(process.pipe);
  process.pipe = -1;
  int status = 0;
  while (waitpid(process.pid, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return status;
}

WorkerOutcome outcome_of(const std::string& received, std::optional<int> status) {
  MessageHeader header;
  if (received.size() >= sizeof header) {
    std::memcpy(&header, received.data(), sizeof header);
    if (received.size() - sizeof header == header.length)
      return {static_cast<int>(header.code), received.substr(sizeof header)};
  }
  WorkerOutcome outcome{exit_numerical, "its process ended without a report"};
  if (status && WIFSIGNALED(*status)) {
    const int number = WTERMSIG(*status);
    outcome.text = fmt::format("killed by signal {} ({})", number, strsignal(number));
    if (number == SIGKILL) {
      outcome.code = exit_files;
      outcome.text += "; the usual reason is that memory ran out";
    }
  } else if (status) {
    outcome.text += fmt::format(", with exit code {}", WEXITSTATUS(*status));
  }
  return outcome;
}

/// Leaves no child behind: at its end, children still running are told to stop and waited for.
class Workers {
 public:
  Workers() = default;
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers() {
    tell_to_stop();
    for (Process& process : processes_)
      if (process.pipe >= 0) static_cast<void>(finish(process));
  }

  void start_all(int workers, const WorkerTask& task) {
    processes_.reserve(static_cast<std::size_t>(workers));  // no exception once one exists
    outcomes_.resize(static_cast<std::size_t>(workers));
    for (int k = 0; k < workers; ++k) processes_.push_back(start(task, k));
  }

  void tell_to_stop() {
    for (const Process& process : processes_)
      if (process.pipe >= 0) kill(process.pid, SIGTERM);
  }

  /// Sleeps until a child writes or ends, at most one period. Returns false if none is left.
  bool wait() {
    std::vector<pollfd> pipes;
    for (const Process& process : processes_) pipes.push_back({process.pipe, POLLIN, 0});
    if (poll(pipes.data(), pipes.size(), period_ms) < 0 && errno != EINTR)
      throw FileError("pipes of the workers", std::strerror(errno));
    for (std::size_t k = 0; k < pipes.size(); ++k) {
      if (pipes[k].fd < 0 || pipes[k].revents == 0 || receive(processes_[k])) continue;
      const std::optional<int> status = finish(processes_[k]);
      outcomes_[k] = outcome_of(processes_[k].received, status);
    }
    return std::ranges::any_of(processes_, [](const Process& p) { return p.pipe >= 0; });
  }

  [[nodiscard]] const std::vector<WorkerOutcome>& outcomes() const noexcept { return outcomes_; }

 private:
  std::vector<Process> processes_;
  std::vector<WorkerOutcome> outcomes_;
};

}  // namespace

WorkerOutcome failed_by(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return {exit_input, error.what()};
  if (dynamic_cast<const FileError*>(&error) != nullptr) return {exit_files, error.what()};
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
    return {exit_files, "not enough memory"};
  return {exit_numerical, fmt::format("unexpected failure, a bug of rondo's: {}", error.what())};
}

std::vector<WorkerOutcome> run_workers(int workers, const WorkerTask& task,
                                       const std::atomic<bool>* stop,
                                       const std::function<void()>& watch) {
  Workers all;
  all.start_all(workers, task);
  bool told = false;
  while (all.wait()) {
    if (watch) watch();
    if (told || !stop || !stop->load(std::memory_order_relaxed)) continue;
    told = true;
    all.tell_to_stop();
  }
  if (watch) watch();
  return all.outcomes();
}

}  // namespace rondo::study

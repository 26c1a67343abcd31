// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/study/sweep/job_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <new>
#include <optional>
#include <utility>

#include "rondo/core/error.hpp"

namespace rondo::study {
namespace {

using Clock = std::chrono::steady_clock;

/// Comes before the message in the pipe.
struct Header {
  std::uint64_t length = 0;
  std::int32_t code = 0;
  std::int32_t ok = 0;
};

// In the child --------------------------------------------------------------------------------

std::atomic<bool> stop_requested{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

extern "C" void request_job_stop(int) {
  stop_requested.store(true);
}

constexpr std::array<int, 3> stop_signals{SIGINT, SIGTERM, SIGHUP};

sigset_t stop_set() {
  sigset_t set;
  sigemptyset(&set);
  for (const int number : stop_signals) sigaddset(&set, number);
  return set;
}

/// What the parent ignores stays ignored (nohup, the shell's background jobs), except SIGTERM,
/// which is how the parent itself tells a job to stop.
void catch_stop_signals() {
  stop_requested.store(false);
  struct sigaction action {};
  action.sa_handler = request_job_stop;
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

JobReport work_guarded(const Job& job, JobChannel& channel) {
  try {
    return job.work(channel);
  } catch (const std::exception& error) {
    return failed_by(error);
  } catch (...) {
    return {job_failed, "unexpected failure, a bug of rondo's: an exception of unknown type", {}};
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

/// noexcept: what escapes nevertheless aborts this process, and the parent sees the signal.
[[noreturn]] void be_child(const Job& job, std::atomic<double>& share, int pipe,
                           pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(1);  // it died before the line above
  catch_stop_signals();
  JobChannel channel(share, stop_requested);
  const JobReport report = work_guarded(job, channel);
  std::fflush(nullptr);
  Header header;
  header.length = report.message.size();
  header.code = report.code;
  header.ok = report.ok.value_or(report.code == job_done) ? 1 : 0;
  const bool sent = write_all(pipe, &header, sizeof header) &&
                    write_all(pipe, report.message.data(), report.message.size());
  _exit(sent ? 0 : 1);  // no destructor, no atexit handler: those are the parent's
}

// In the parent -------------------------------------------------------------------------------

FileError cannot_start(const Job& job, int error) {
  return {fmt::format("job {}", job.name),
          fmt::format("its process cannot be started: {}; allow more processes and open files "
                      "(ulimit -u, ulimit -n) or run fewer jobs at once",
                      std::strerror(error))};
}

/// The outcome the child reported; none if it ended before its report was through.
std::optional<JobOutcome> reported(const std::string& received) {
  Header header;
  if (received.size() < sizeof header) return std::nullopt;
  std::memcpy(&header, received.data(), sizeof header);
  if (received.size() - sizeof header != header.length) return std::nullopt;
  JobOutcome outcome;
  outcome.code = header.code;
  outcome.message = received.substr(sizeof header);
  if (header.ok != 0)
    outcome.status = JobStatus::done;
  else
    outcome.status = header.code == job_interrupted ? JobStatus::interrupted : JobStatus::failed;
  return outcome;
}

/// `status`: of waitpid; none where the system does not keep it (the parent ignores SIGCHLD).
JobOutcome not_reported(std::optional<int> status) {
  JobOutcome outcome;
  outcome.status = JobStatus::failed;
  outcome.code = job_failed;
  outcome.message = "its process ended without a report";
  if (status && WIFSIGNALED(*status)) {
    const int number = WTERMSIG(*status);
    outcome.message = fmt::format("killed by signal {} ({})", number, strsignal(number));
    if (number == SIGKILL) {
      outcome.code = job_machine;
      outcome.message += "; the usual reason is that memory ran out";
    }
  } else if (status) {
    outcome.message += fmt::format(", with exit code {}", WEXITSTATUS(*status));
  }
  return outcome;
}

std::optional<int> wait_for(pid_t pid) {
  int status = 0;
  while (waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return std::nullopt;
  return status;
}

}  // namespace

JobReport failed_by(const std::exception& error) {
  if (dynamic_cast<const InputError*>(&error) != nullptr) return {job_input, error.what(), {}};
  if (dynamic_cast<const FileError*>(&error) != nullptr) return {job_machine, error.what(), {}};
  if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
    return {job_machine, "not enough memory", {}};
  return {job_failed, fmt::format("unexpected failure, a bug of rondo's: {}", error.what()), {}};
}

void JobChannel::progress(long long done, long long total) noexcept {
  if (total > 0)
    share_.store(static_cast<double>(done) / static_cast<double>(total), std::memory_order_relaxed);
}

JobProcess start_job(const Job& job, std::size_t index, std::atomic<double>& share) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw cannot_start(job, errno);
  std::fflush(nullptr);  // what is buffered here would be written by the child once more
  const pid_t parent = getpid();
  const sigset_t stops = stop_set();
  sigset_t before;
  pthread_sigmask(SIG_BLOCK, &stops, &before);  // until the child has its own handlers
  const auto start = Clock::now();
  const pid_t pid = fork();
  if (pid == 0) {
    close(ends[0]);
    be_child(job, share, ends[1], parent);
  }
  const int error = errno;
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  close(ends[1]);
  if (pid > 0) return {index, pid, ends[0], {}, start};
  close(ends[0]);
  throw cannot_start(job, error);
}

bool read_report(JobProcess& process) {
  std::array<char, 65536> buffer;
  ssize_t size = 0;
  do size = read(process.pipe, buffer.data(), buffer.size());
  while (size < 0 && errno == EINTR);
  if (size > 0) process.received.append(buffer.data(), static_cast<std::size_t>(size));
  return size > 0;
}

JobOutcome finish_job(const JobProcess& process) {
  close(process.pipe);
  const std::optional<int> status = wait_for(process.pid);
  const std::optional<JobOutcome> report = reported(process.received);
  JobOutcome outcome = report ? *report : not_reported(status);
  outcome.wall_s = std::chrono::duration<double>(Clock::now() - process.start).count();
  return outcome;
}

}  // namespace rondo::study

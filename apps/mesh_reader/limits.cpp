// SPDX-License-Identifier: BSD-3-Clause
#include "limits.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

namespace rondo::reader {
namespace {

/// Measured on 10^6 quadrilaterals: 3.8 bytes of memory per byte of file (4.1 binary), 4.8 (2.2
/// ASCII); the shortest lines that a file can have need about three times as much.
constexpr std::uint64_t memory_per_byte = 16, memory_at_least = 512ULL << 20;
/// Measured: 30 MB/s (2.2 ASCII). A busy machine is allowed 30 times as long.
constexpr std::uint64_t bytes_per_second = 1'000'000, seconds_at_least = 20;

/// Address space in use now [B].
std::uint64_t memory_in_use() {
  std::uint64_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

std::uint64_t memory_of_machine() {
  return static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

/// Sets a limit, but never above the present one.
void limit(int resource, std::uint64_t value) {
  rlimit now{};
  if (getrlimit(static_cast<__rlimit_resource>(resource), &now) != 0) return;
  now.rlim_cur = std::min<rlim_t>(value, now.rlim_max);
  setrlimit(static_cast<__rlimit_resource>(resource), &now);
}

}  // namespace

std::uint64_t limit_process(std::uint64_t file_bytes) {
  std::signal(SIGINT, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  const std::uint64_t memory =
      std::min(memory_at_least + memory_per_byte * file_bytes, memory_of_machine());
  limit(RLIMIT_AS, memory_in_use() + memory);
  limit(RLIMIT_CPU, seconds_at_least + file_bytes / bytes_per_second);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_FSIZE, 1U << 20);
  return memory;
}

}  // namespace rondo::reader

// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/core/limits/memory_limits.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "rondo/core/limits/control_groups.hpp"

namespace rondo {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

/// "max" and text that cannot be read mean no limit.
std::size_t limit_in(const fs::path& file) {
  std::ifstream in(file);
  std::size_t bytes = 0;
  return in >> bytes ? bytes : no_limit;
}

/// Memory mapped by this process, in total and as data [B]; 0 if that cannot be read.
std::array<std::size_t, 2> mapped_memory() {
  std::ifstream in("/proc/self/statm");
  std::array<std::size_t, 6> pages{};  // size, resident, shared, text, library, data
  for (std::size_t& n : pages)
    if (!(in >> n)) return {};
  const long page = sysconf(_SC_PAGESIZE);
  const std::size_t bytes = page > 0 ? static_cast<std::size_t>(page) : 0;
  return {pages[0] * bytes, pages[5] * bytes};
}

/// Further memory that libraries will map, used or not: a buffer of OpenBLAS, 128 MiB, without
/// which it waits for ever; the heap of the writing thread, 128 MiB when made; stacks of threads.
constexpr std::size_t mapped_by_libraries = 320'000'000;

std::size_t left_of(__rlimit_resource resource, std::size_t mapped) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return no_limit;
  const std::size_t taken = mapped + mapped_by_libraries;
  return limit.rlim_cur > taken ? limit.rlim_cur - taken : 0;
}

}  // namespace

std::size_t control_group_limit(const std::string& groups, const fs::path& mount) {
  std::size_t least = no_limit;
  for (const fs::path& folder : control_group_folders(groups, mount, "memory"))
    for (const char* file : {"memory.max", "memory.limit_in_bytes"})
      least = std::min(least, limit_in(folder / file));
  return least;
}

std::size_t physical_memory() noexcept {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(page)
                               : 0;
}

AllowedMemory allowed_memory() {
  AllowedMemory allowed;
  const auto limit = [&](std::size_t bytes, const char* source) {
    if (bytes < allowed.bytes) allowed = {bytes, source};
  };
  const std::size_t physical = physical_memory();
  limit(physical > 0 ? physical : no_limit, "this machine has");
  limit(control_group_limit(text_or_nothing("/proc/self/cgroup"), "/sys/fs/cgroup"),
        "the control group of this process allows");
  const auto [mapped, data] = mapped_memory();
  limit(left_of(RLIMIT_AS, mapped), "the limit of the address space (ulimit -v) leaves");
  limit(left_of(RLIMIT_DATA, data), "the limit of data (ulimit -d) leaves");
  return allowed;
}

}  // namespace rondo

// SPDX-License-Identifier: BSD-3-Clause
/// @file  How much memory this process may take: of the machine, of its control group, of ulimit.
#pragma once
#include <cstddef>
#include <filesystem>
#include <limits>
#include <string>

namespace rondo {

struct AllowedMemory {
  std::size_t bytes = std::numeric_limits<std::size_t>::max();  ///< the largest number: no limit
  std::string source = "nothing limits it to";  ///< as in "this machine has", before the bytes
};

/// The least of what limits this process now. What a process has mapped already, and what its
/// libraries will map, counts against ulimit's limits, and is taken off them.
AllowedMemory allowed_memory();

/// Physical memory of this machine [B]; 0: unknown.
std::size_t physical_memory() noexcept;

/// The least limit of the control groups, version 1 and 2, that a process is in, and of those
/// above them [B]; the largest number: none.
/// @param groups text of /proc/self/cgroup; `mount` where they are seen, /sys/fs/cgroup
std::size_t control_group_limit(const std::string& groups, const std::filesystem::path& mount);

}  // namespace rondo

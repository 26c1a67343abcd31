// SPDX-License-Identifier: BSD-3-Clause
/// @file  The memory that this process may take: limits of machine, control group and ulimit.
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

/// The smallest of the limits of this process now. Memory that the process has mapped already or
/// that its libraries will map counts against the limits of ulimit and is subtracted from them.
AllowedMemory allowed_memory();

/// Physical memory of this machine [B]; 0: unknown.
std::size_t physical_memory() noexcept;

/// The smallest limit of the control groups, version 1 and 2, that a process is in, and of those
/// above them [B]; the largest number: no limit.
/// @param groups text of /proc/self/cgroup; `mount`: their mount point, /sys/fs/cgroup
std::size_t control_group_limit(const std::string& groups, const std::filesystem::path& mount);

}  // namespace rondo

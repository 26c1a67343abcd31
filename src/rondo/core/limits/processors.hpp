// SPDX-License-Identifier: BSD-3-Clause
/// @file  The number of processors that this process may use. It may be smaller than the number in
/// the machine because of taskset, a batch system or a container.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rondo {

/// The number of processors in the affinity mask of the calling thread or the quota of its control
/// groups rounded down, whichever is less; at least 1. The default numbers of threads and jobs use
/// it.
[[nodiscard]] int allowed_processors();

/// Limits the threads that OpenBLAS and OpenMP start from this thread by default to that number,
/// unless OPENBLAS_NUM_THREADS and OMP_NUM_THREADS set it.
void use_allowed_processors();

// For tests -----------------------------------------------------------------------------------

/// The quota as a number of processors; none: there is no quota, or the text does not give one.
/// @param cpu_max of cgroup v2: "150000 100000" is 1.5, "max 100000" none
[[nodiscard]] std::optional<double> quota_of(std::string_view cpu_max);

/// The smallest quota of the control groups, version 1 and 2, of a process and of those above them.
/// @param groups text of /proc/self/cgroup @param mount their mount point, /sys/fs/cgroup
[[nodiscard]] std::optional<double> least_quota(const std::string& groups,
                                                const std::filesystem::path& mount);

}  // namespace rondo

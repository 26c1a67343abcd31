// SPDX-License-Identifier: BSD-3-Clause
/// @file  How many processors this process may use, which may be fewer than the machine has: by
/// taskset, a batch system, a container.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace rondo {

/// The number of processors in the affinity of the calling thread, or what the quotas of its
/// control groups are worth, rounded down, where that is less; at least 1. Defaults of threads and
/// jobs come from here.
[[nodiscard]] int allowed_processors();

/// OpenBLAS and OpenMP start no more threads than that by themselves, in this thread, where
/// OPENBLAS_NUM_THREADS and OMP_NUM_THREADS do not say how many.
void use_allowed_processors();

// For tests -----------------------------------------------------------------------------------

/// Processors that a quota is worth; none: there is no quota, or the text is none.
/// @param cpu_max of cgroup v2: "150000 100000" is 1.5, "max 100000" none
[[nodiscard]] std::optional<double> quota_of(std::string_view cpu_max);

/// The least quota of the control groups, version 1 and 2, that a process is in, and of those above
/// them. @param groups text of /proc/self/cgroup @param mount where they are seen, /sys/fs/cgroup
[[nodiscard]] std::optional<double> least_quota(const std::string& groups,
                                                const std::filesystem::path& mount);

}  // namespace rondo

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Control groups of Linux, version 1 and 2, that limit a process.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace rondo {

/// Folders of the groups that a process is in for a controller, and of those above them: each may
/// have files of limits. In a container the group's own path may not be seen, but the mount is that
/// of the container.
/// @param groups text of /proc/self/cgroup @param mount where they are seen, /sys/fs/cgroup
/// @param controller "memory", "cpu"
[[nodiscard]] std::vector<std::filesystem::path> control_group_folders(
    const std::string& groups, const std::filesystem::path& mount, const std::string& controller);

/// A small file as a text; empty where it cannot be read.
[[nodiscard]] std::string text_or_nothing(const std::filesystem::path& file);

}  // namespace rondo

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Control groups of Linux, version 1 and 2, that limit a process.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace rondo {

/// The folders of a controller's groups that a process is in, and of the groups above them; each
/// may contain files of limits. In a container the group's own path may be invisible, but the mount
/// point shows the group of the container.
/// @param groups text of /proc/self/cgroup @param mount where they are seen, /sys/fs/cgroup
/// @param controller "memory", "cpu"
[[nodiscard]] std::vector<std::filesystem::path> control_group_folders(
    const std::string& groups, const std::filesystem::path& mount, const std::string& controller);

/// A small file as a text; empty where it cannot be read.
[[nodiscard]] std::string text_or_nothing(const std::filesystem::path& file);

}  // namespace rondo

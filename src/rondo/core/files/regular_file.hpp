// SPDX-License-Identifier: BSD-3-Clause
/// @file  Only regular files are read, because opening a FIFO waits for a writer, and a device may
/// never end.
#pragma once
#include <filesystem>
#include <string>

namespace rondo {

/// "a FIFO", "a directory", "a socket" or "a device" if the path is one. Empty: a regular file or a
/// link to one, or nothing, which opening it then reports. The file is not opened.
std::string kind_of_no_file(const std::filesystem::path& file);

/// @throws FileError if it is a FIFO, a directory, a socket or a device
void demand_regular_file(const std::filesystem::path& file);

}  // namespace rondo

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Files that are read must be regular ones: opening a FIFO waits for a writer, and a device
/// may never end.
#pragma once
#include <filesystem>
#include <string>

namespace rondo {

/// "a FIFO", "a directory", "a socket", "a device" where such a thing is there. Empty: a regular
/// file, or a link to one, or nothing, of which opening it tells. It is not opened.
std::string kind_of_no_file(const std::filesystem::path& file);

/// @throws FileError: is a FIFO (a directory, a socket, a device), not a regular file
void demand_regular_file(const std::filesystem::path& file);

}  // namespace rondo

// SPDX-License-Identifier: BSD-3-Clause
/// @file  A zip file of texts and files, by minizip.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rondo::app {

/// Name in the zip file, and contents.
using ZipEntry = std::pair<std::string, std::string>;

/// Replaces `file` once the new one is complete; the same entries give the same bytes.
/// @throws FileError
void write_zip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries);

}  // namespace rondo::app

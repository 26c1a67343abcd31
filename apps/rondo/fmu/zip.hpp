// SPDX-License-Identifier: BSD-3-Clause
/// @file  A zip file of texts and files, by minizip.
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rondo::app {

/// Name within, and content.
using ZipEntry = std::pair<std::string, std::string>;

/// Takes the place of `file` once it is whole; the same entries give the same bytes.
/// @throws FileError
void write_zip(const std::filesystem::path& file, const std::vector<ZipEntry>& entries);

}  // namespace rondo::app

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Where results go that were given no -o (docs/decisions/029-default-directory.md).
#pragma once
#include <filesystem>
#include <string_view>

namespace rondo::app {

/// In the working folder: cases/ledge.toml -> ledge; cases/ledge -> ledge.results.
/// @param suffix  of the name
std::filesystem::path default_directory(const std::filesystem::path& input,
                                        std::string_view suffix = {});

/// The same of what is gone on with: that beside the input, where earlier versions put it, if it
/// has the file `record` and the one in the working folder has not. Says so in a warning.
std::filesystem::path resumed_directory(const std::filesystem::path& input,
                                        std::string_view record);

}  // namespace rondo::app

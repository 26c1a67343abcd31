// SPDX-License-Identifier: BSD-3-Clause
/// @file  Default results directory without -o (docs/decisions/029-default-directory.md).
#pragma once
#include <filesystem>
#include <string_view>

namespace rondo::app {

/// A name in the working folder: cases/ledge.toml -> ledge; cases/ledge -> ledge.results.
/// @param suffix  of the name
std::filesystem::path default_directory(const std::filesystem::path& input,
                                        std::string_view suffix = {});

/// The default directory for --resume. It is the one beside the input, where earlier versions put
/// it, if that has the file `record` and the one in the working folder has not; a warning says so.
std::filesystem::path resumed_directory(const std::filesystem::path& input,
                                        std::string_view record);

}  // namespace rondo::app

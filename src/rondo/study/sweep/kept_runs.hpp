// SPDX-License-Identifier: BSD-3-Clause
/// @file  Finds the runs of a study that exist already: complete, by this program, of this case.
#pragma once
#include <filesystem>

#include "rondo/case/case.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// Whether it was written by exactly this program, because a new build may give other numbers.
[[nodiscard]] bool is_of_this_program(const Json& j);

/// -1 if there is no such number.
[[nodiscard]] double number_in(const Json& j, const char* key);

/// Whether case.toml in the directory is this case, and the copy of the mesh is its mesh.
[[nodiscard]] bool is_case_of(const std::filesystem::path& directory, const Case& c);

/// Whether the run in the directory finished or failed by itself, with files that are bit for bit
/// what was written. A file that cannot be read counts as missing.
/// @param modes what run.json calls the modes that it begins with; empty: none
[[nodiscard]] bool run_is_there(const std::filesystem::path& directory, const Case& c,
                                const std::string& modes);

/// Removes files and folders of unfinished writes, left by a program that was killed.
void remove_unfinished(const std::filesystem::path& directory);

}  // namespace rondo::study

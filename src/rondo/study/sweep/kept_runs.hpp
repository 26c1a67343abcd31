// SPDX-License-Identifier: BSD-3-Clause
/// @file  Which runs of a study are there already: complete, of this program and of this case.
#pragma once
#include <filesystem>

#include "rondo/case/case.hpp"
#include "rondo/output/run_files.hpp"

namespace rondo::study {

/// Written by this very program: one built anew may give other numbers.
[[nodiscard]] bool is_of_this_program(const Json& j);

/// -1 where it has no such number.
[[nodiscard]] double number_in(const Json& j, const char* key);

/// Its case.toml is this case's, and so is its copy of the mesh.
[[nodiscard]] bool is_case_of(const std::filesystem::path& directory, const Case& c);

/// The run in the directory came to its end, or failed there by itself; its files are, to the
/// bit, what was written. What cannot be read is not there.
/// @param modes what run.json calls the modes that it begins with; empty: none
[[nodiscard]] bool run_is_there(const std::filesystem::path& directory, const Case& c,
                                const std::string& modes);

/// What a program left that was killed while it wrote: files and folders of unfinished writes.
void remove_unfinished(const std::filesystem::path& directory);

}  // namespace rondo::study

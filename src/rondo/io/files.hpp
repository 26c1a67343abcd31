// SPDX-License-Identifier: BSD-3-Clause
/// @file  Results directories and small files.
#pragma once
#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace rondo::io {

/// Makes `directory` ready for a run: creates it with its parents, refuses one that holds another
/// run (run.json, results.h5 or history.csv) unless `overwrite`, which removes that run's files
/// (and nothing else). @throws InputError (holds a run; is not a directory), FileError (cannot
/// create).
void prepare_results_directory(const std::filesystem::path& directory, bool overwrite);

/// Written beside, then renamed: readers never see half a file. @throws FileError
void write_file(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);
/// For a full disk: over the old text of a small file, in place, which asks for no new room.
/// False where that cannot be done either.
bool overwrite_json(const std::filesystem::path& file, const nlohmann::ordered_json& json) noexcept;

}  // namespace rondo::io

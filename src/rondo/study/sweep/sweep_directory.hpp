// SPDX-License-Identifier: BSD-3-Clause
/// @file  The directory of a sweep: its contents, and whether a sweep may start or resume there.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// The format in sweep.json.
inline constexpr const char* sweep_format = "rondo sweep 1";
/// Folder in the directory of a sweep run in shards; it has a folder for each shard.
inline constexpr const char* shards_folder = "shards";

/// SWEEP/runs/0012 for member 11 of n.
[[nodiscard]] std::filesystem::path run_directory(const std::filesystem::path& sweep,
                                                  std::size_t member, std::size_t n);

/// Hash that is equal for studies with the same table.
[[nodiscard]] std::string hash_of(const SweepStudy& study, const PlannedSweep& plan);

/// Checks by its sweep.json that it is this sweep, made by this program. @param otherwise advice at
/// the end of the message about another sweep @throws InputError, FileError
void demand_same_sweep(const std::filesystem::path& directory, const std::string& hash,
                       const std::string& otherwise);

/// Checks that no file of a sweep or of a run exists. @param runs nor runs/ @throws InputError
void refuse_foreign_files(const std::filesystem::path& directory, bool runs);

/// @throws FileError
void make_directory(const std::filesystem::path& directory);

/// Creates the directory, or accepts what the request allows there: nothing, this sweep to resume,
/// or a sweep to replace. Nothing else is changed. @throws InputError, FileError
void prepare_sweep(const SweepRequest& request, const std::string& hash);

/// @throws FileError: there is no space for the runs that do not exist yet
void demand_room(const SweepRequest& request, const PlannedSweep& plan);

/// With --overwrite, removes the files of a sweep and its PODs. @pre the directory is locked
void clear_sweep(const SweepRequest& request);

}  // namespace rondo::study

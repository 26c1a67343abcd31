// SPDX-License-Identifier: BSD-3-Clause
/// @file  The directory of a sweep: what is in it, and whether a sweep may begin or go on there.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// Of sweep.json.
inline constexpr const char* sweep_format = "rondo sweep 1";
/// In the directory of a sweep that is made in shards: a folder for each.
inline constexpr const char* shards_folder = "shards";

/// SWEEP/runs/0012 for member 11 of n.
[[nodiscard]] std::filesystem::path run_directory(const std::filesystem::path& sweep,
                                                  std::size_t member, std::size_t n);

/// Equal for studies that give the same table.
[[nodiscard]] std::string hash_of(const SweepStudy& study, const PlannedSweep& plan);

/// By its sweep.json it is this sweep, of this program. @param otherwise said last of what can be
/// done about another one @throws InputError, FileError
void demand_same_sweep(const std::filesystem::path& directory, const std::string& hash,
                       const std::string& otherwise);

/// What a sweep would write is not there; nor a run. @param runs nor runs/ @throws InputError
void refuse_foreign_files(const std::filesystem::path& directory, bool runs);

/// @throws FileError
void make_directory(const std::filesystem::path& directory);

/// Makes the directory, or finds there what the request allows: nothing, or this sweep to go on
/// with, or one to be replaced. Nothing else is touched. @throws InputError, FileError
void prepare_sweep(const SweepRequest& request, const std::string& hash);

/// @throws FileError: no room for the runs that are not there yet
void demand_room(const SweepRequest& request, const PlannedSweep& plan);

/// With --overwrite, what a sweep has left, and PODs of it. @pre the directory is taken
void clear_sweep(const SweepRequest& request);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  The result of a shard for --collect: SWEEP/shards/0003-of-0008/rows.json. The shard alone
/// writes it, completely or not at all.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "rondo/output/run_files.hpp"
#include "rondo/study/shards/shard.hpp"
#include "rondo/study/sweep/sweep.hpp"
#include "rondo/study/sweep/sweep_results.hpp"

namespace rondo::study {

/// Identifies a sweep and the program that runs it; the same for all its shards.
struct SweepIdentity {
  std::string members_hash;           ///< decides; the others explain differences
  std::string study_hash, base_hash;  ///< of the files' texts
  std::vector<std::string> settings;  ///< of --set
  std::string version, build_id;
};

struct ShardFile {
  Shard shard;
  std::string status;  ///< "running", "done", "failed" (some runs did), "interrupted"
  std::string host;    ///< that ran it or is running it
  long long process = 0;
  SweepIdentity identity;
  std::vector<std::pair<std::size_t, MemberRow>> rows;  ///< members from 0; empty while it runs
  double wall_s = 0.0;
};

[[nodiscard]] SweepIdentity identity_of(const SweepRequest& request, const SweepStudy& study,
                                        const PlannedSweep& plan);

/// Describes the differences between a sweep that was found and this one; empty: none that matters.
[[nodiscard]] std::string difference(const SweepIdentity& found, const SweepIdentity& own);

/// SWEEP/shards/0003-of-0008
[[nodiscard]] std::filesystem::path shard_directory(const std::filesystem::path& sweep,
                                                    const Shard& shard);

/// Shards that have a folder in that of the sweep, ascending.
[[nodiscard]] std::vector<Shard> shards_in(const std::filesystem::path& sweep);

[[nodiscard]] bool has_shard_file(const std::filesystem::path& sweep, const Shard& shard);

/// @throws FileError
void write_shard_file(const std::filesystem::path& sweep, const ShardFile& file);
/// @throws FileError: cannot be read, damaged
[[nodiscard]] ShardFile read_shard_file(const std::filesystem::path& sweep, const Shard& shard);

}  // namespace rondo::study

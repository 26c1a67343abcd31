// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo sweep --shard and --collect: allowed combinations of options, and their output.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "commands.hpp"
#include "rondo/study/shards/shard_sweep.hpp"

namespace rondo::app {

/// The shard that was requested; none: the whole sweep. @throws InputError: invalid, or combined
/// with options that make no sense with it
[[nodiscard]] std::optional<study::Shard> asked_shard(const SweepArguments& arguments);

/// Warns of failures and large strains of any sweep. @param more where all failures are listed
void warn_of_runs(const study::SweepReport& report, const std::string& more);

/// Stores the result for the document of --collect.
void keep_collected(Telling& tell, const study::CollectReport& report,
                    const std::filesystem::path& directory);

/// These functions return the exit code.
int finish_shard(const study::SweepReport& report, const study::Shard& shard,
                 const study::SweepRequest& request);
int finish_collected(const study::CollectReport& report, const study::SweepRequest& request);

}  // namespace rondo::app

// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo sweep --shard and --collect: what may be asked for together, and what is told.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "commands.hpp"
#include "rondo/study/shards/shard_sweep.hpp"

namespace rondo::app {

/// The shard asked for; none: all of the sweep. @throws InputError: wrong, or with other options
/// that make no sense with it
[[nodiscard]] std::optional<study::Shard> asked_shard(const SweepArguments& arguments);

/// Failures and strains, of any sweep. @param more where all failures are told
void warn_of_runs(const study::SweepReport& report, const std::string& more);

/// For the document of --collect.
void keep_collected(Telling& tell, const study::CollectReport& report,
                    const std::filesystem::path& directory);

/// Each returns the exit code.
int finish_shard(const study::SweepReport& report, const study::Shard& shard,
                 const study::SweepRequest& request);
int finish_collected(const study::CollectReport& report, const study::SweepRequest& request);

}  // namespace rondo::app

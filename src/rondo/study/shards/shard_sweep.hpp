// SPDX-License-Identifier: BSD-3-Clause
/// @file  A sweep made in shards, by jobs that know nothing of each other, and their tables
/// collected (docs/clusters.md). Shards write only what is theirs: SWEEP/shards/0003-of-0008 and
/// SWEEP/runs of their members.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "rondo/study/shards/shard.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// The members of the shard, built, with their time: as check_sweep(). @throws InputError
[[nodiscard]] DrySweep check_shard(const SweepRequest& request, const Shard& shard, Team& team);

/// Makes the members of the shard: as run_sweep(), but for the tables. The report is of these.
/// @throws InputError: the study is wrong, the directory holds this shard already (without
/// request.resume), shards of another division or of another sweep; FileError
[[nodiscard]] SweepReport run_shard(const SweepRequest& request, const Shard& shard, Team& team);

struct CollectReport : SweepReport {
  std::size_t shards = 0;           ///< of the sweep
  std::vector<Shard> unfinished;    ///< to be made, or gone on with
  std::vector<std::string> states;  ///< of the unfinished, in words
};

/// The tables of all shards, as of the undivided sweep; of unfinished ones what is there.
/// @throws InputError: no shards there, shards of different divisions, sweeps or programs;
/// FileError
[[nodiscard]] CollectReport collect_shards(const SweepRequest& request, Team& team);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  A sweep run in shards by independent jobs, whose tables are collected afterwards
/// (docs/clusters.md). A shard writes only its own files: SWEEP/shards/0003-of-0008 and SWEEP/runs
/// of its members.
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "rondo/study/shards/shard.hpp"
#include "rondo/study/sweep/sweep.hpp"

namespace rondo::study {

/// The members of the shard, built, with their time, like check_sweep(). @throws InputError
[[nodiscard]] DrySweep check_shard(const SweepRequest& request, const Shard& shard, Team& team);

/// Runs the members of the shard like run_sweep(), but without the tables. The report is of these.
/// @throws InputError: the study is wrong, the directory holds this shard already (without
/// request.resume), shards of another division or of another sweep; FileError
[[nodiscard]] SweepReport run_shard(const SweepRequest& request, const Shard& shard, Team& team);

struct CollectReport : SweepReport {
  std::size_t shards = 0;           ///< of the sweep
  std::vector<Shard> unfinished;    ///< to be run or resumed
  std::vector<std::string> states;  ///< of the unfinished, in words
};

/// Writes the tables of all shards, as for the undivided sweep; unfinished shards give what exists.
/// @throws InputError: no shards there, shards of different divisions, sweeps or programs;
/// FileError
[[nodiscard]] CollectReport collect_shards(const SweepRequest& request, Team& team);

}  // namespace rondo::study

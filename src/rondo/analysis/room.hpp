// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the machine has room for a run, memory and disk, told before it begins.
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

#include "rondo/analysis/build.hpp"
#include "rondo/analysis/crush_build.hpp"
#include "rondo/analysis/estimate.hpp"
#include "rondo/analysis/run.hpp"
#include "rondo/output/snapshot_schedule.hpp"

namespace rondo::study {

/// @param needed [B] @throws InputError at the key that makes the mesh so large: this process may
/// not take that much memory
void demand_memory(const Case& c, std::size_t nodes, std::size_t needed);

/// What a run writes [B]; estimated but for results.h5.
struct DiskNeed {
  std::size_t all = 0;           ///< checkpoints included
  std::size_t largest_file = 0;  ///< of the files that grow
};

DiskNeed disk_needed(const Case& c, const Setup& setup, const SnapshotSchedule& schedule);
DiskNeed disk_needed(const Case& c, const CrushSetup& setup);

/// Called before anything is written or removed. @throws FileError: less is free, or the limit of a
/// file's size (ulimit -f) is smaller
void demand_disk(const RunOptions& options, const DiskNeed& need);

}  // namespace rondo::study

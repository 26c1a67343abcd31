// SPDX-License-Identifier: BSD-3-Clause
/// @file  Whether the disk can take what a run writes, told before it begins.
#pragma once
#include <cstddef>

#include "rondo/output/recorder.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Size of what a run writes [B]; estimated but for results.h5.
struct DiskNeed {
  std::size_t all = 0;           ///< checkpoints included
  std::size_t largest_file = 0;  ///< largest of the files that grow
};

/// @param keeps_checkpoints the analysis does
DiskNeed disk_needed(const RecordPlan& plan, bool keeps_checkpoints);

/// Called before anything is written or removed. @throws FileError: less is free, or the limit of a
/// file's size (ulimit -f) is smaller
void demand_disk(const RunOptions& options, const DiskNeed& need);

}  // namespace rondo::study

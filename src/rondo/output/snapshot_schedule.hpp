// SPDX-License-Identifier: BSD-3-Clause
/// @file  When a run takes its snapshots.
#pragma once
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

struct SnapshotSchedule {
  std::vector<long long> steps;  ///< ascending; a snapshot each
  double interval = 0.0;         ///< time between them; 0: there is no second one [s]
};

/// output.snapshots times evenly spread over [output.snapshots_from, end], each at the nearest
/// step, the last one at the last step. Fewer where steps are fewer.
SnapshotSchedule snapshot_schedule(const Output& output, double dt, long long n_steps);

/// The same for a run that now ends after `n_steps`: of a longer one it goes on at the same
/// interval, and there is one at the last step.
SnapshotSchedule with_end(SnapshotSchedule schedule, const Output& output, double dt,
                          long long n_steps);

}  // namespace rondo::study

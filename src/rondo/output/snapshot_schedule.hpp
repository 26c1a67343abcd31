// SPDX-License-Identifier: BSD-3-Clause
/// @file  The steps at which a run takes its snapshots.
#pragma once
#include <vector>

#include "rondo/case/case.hpp"

namespace rondo::study {

struct SnapshotSchedule {
  std::vector<long long> steps;  ///< ascending; one snapshot at each
  double interval = 0.0;         ///< time between snapshots; 0: there is only one [s]
};

/// output.snapshots times evenly spread over [output.snapshots_from, end], each at the nearest
/// step, the last at the last step. There are fewer if the run has fewer steps.
SnapshotSchedule snapshot_schedule(const Output& output, double dt, long long n_steps);

/// The schedule of a run that now ends after `n_steps`: if it becomes longer, it continues at the
/// same interval, with a snapshot at the last step.
SnapshotSchedule with_end(SnapshotSchedule schedule, const Output& output, double dt,
                          long long n_steps);

}  // namespace rondo::study

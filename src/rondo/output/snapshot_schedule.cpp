// SPDX-License-Identifier: BSD-3-Clause
#include "rondo/output/snapshot_schedule.hpp"

#include <algorithm>
#include <cmath>

#include "rondo/core/contract.hpp"

namespace rondo::study {
namespace {

/// Adds the step nearest to the time, unless it is there already.
void add(SnapshotSchedule& schedule, double time, double dt, long long n_steps) {
  const auto step = static_cast<long long>(std::llround(time / dt));
  const long long within = std::clamp(step, 0LL, n_steps);
  if (schedule.steps.empty() || within > schedule.steps.back()) schedule.steps.push_back(within);
}

}  // namespace

SnapshotSchedule snapshot_schedule(const Output& output, double dt, long long n_steps) {
  RONDO_DEMAND(dt > 0.0 && std::isfinite(dt) && n_steps >= 0, dt, n_steps);
  SnapshotSchedule schedule;
  const int count = output.snapshots;
  const double from = output.snapshots_from, end = static_cast<double>(n_steps) * dt;
  for (int j = 0; j < count; ++j) {
    const double share = count > 1 ? static_cast<double>(j) / (count - 1) : 1.0;
    add(schedule, from + share * (end - from), dt, n_steps);
  }
  if (count > 1) schedule.interval = (end - from) / (count - 1);
  return schedule;
}

SnapshotSchedule with_end(SnapshotSchedule schedule, const Output& output, double dt,
                          long long n_steps) {
  RONDO_DEMAND(dt > 0.0 && n_steps >= 0, dt, n_steps);
  std::vector<long long>& steps = schedule.steps;
  if (steps.empty()) return schedule;
  std::erase_if(steps, [&](long long step) { return step > n_steps; });
  const double end = static_cast<double>(n_steps) * dt, from = output.snapshots_from;
  if (schedule.interval > 0.0 && !steps.empty()) {
    const double last = static_cast<double>(steps.back()) * dt;
    double j = std::floor((last - from) / schedule.interval);
    for (; from + j * schedule.interval < end; j += 1.0)
      add(schedule, from + j * schedule.interval, dt, n_steps);
  }
  add(schedule, end, dt, n_steps);
  return schedule;
}

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady states (analysis.kind = "steady-rolling") among the runs from which a reduced
/// model is built (docs/reduced.md, 3b).
#pragma once
#include <span>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace rondo::study {

[[nodiscard]] bool is_steady(const io::RunReader& run);

/// Changes the case of a steady state to a motion in time with its height and speed, which may be
/// results, for half a turn. @throws InputError: no snapshots, the co-rotating frame; FileError:
/// run.json has no height and speed
void take_steady(const io::RunReader& run, bool turning, Case& c);

/// The case with its wheel at rest off the ground, for all that does not depend on the motion.
[[nodiscard]] Case off_the_ground(Case c);

/// Weights steady states, if there are also runs in time, such that both count equally in total.
void weigh_steady(std::span<const io::RunReader> runs, std::vector<SnapshotColumn>& columns);

/// Runs that are left out in turn for the error estimate: each run in time, and a limited number of
/// steady states, evenly chosen, because there may be hundreds.
[[nodiscard]] std::vector<std::size_t> runs_to_leave_out(std::span<const io::RunReader> runs);

}  // namespace rondo::study

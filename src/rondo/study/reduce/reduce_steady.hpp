// SPDX-License-Identifier: BSD-3-Clause
/// @file  Steady states (analysis.kind = "steady-rolling") among the runs that a reduced model is
/// built from (docs/reduced.md, 3b).
#pragma once
#include <span>
#include <vector>

#include "rondo/case/case.hpp"
#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace rondo::study {

[[nodiscard]] bool is_steady(const io::RunReader& run);

/// Makes of the case of a steady state one of motion in time: its height and speed, which may be
/// results, for half a turn. @throws InputError: no snapshots, the co-rotating frame; FileError:
/// run.json has no height and speed
void take_steady(const io::RunReader& run, bool turning, Case& c);

/// The case with its wheel off the ground, at rest: for what does not hang on the motion.
[[nodiscard]] Case off_the_ground(Case c);

/// Steady states, where they are beside runs in time, count as much in all as these do.
void weigh_steady(std::span<const io::RunReader> runs, std::vector<SnapshotColumn>& columns);

/// Runs that are left out in turn for the error estimate: each in time, and of steady states, of
/// which there may be hundreds, so many of all their row.
[[nodiscard]] std::vector<std::size_t> runs_to_leave_out(std::span<const io::RunReader> runs);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  A state of a motion as a snapshot of the results.
#pragma once
#include "rondo/case/setup.hpp"
#include "rondo/output/snapshot.hpp"

namespace rondo::study {

/// Fills and returns `snapshot`: fields, contacts, place of the frame; of a loaded rim the angle at
/// the velocity's time is the mean of those at both ends of the step.
Snapshot& fill_snapshot(const Setup& setup, const dynamics::State& state, Snapshot& snapshot);

}  // namespace rondo::study

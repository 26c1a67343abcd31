// SPDX-License-Identifier: BSD-3-Clause
/// @file  Snapshots of a motion in time.
#pragma once
#include "rondo/case/setup.hpp"
#include "rondo/io/snapshot.hpp"

namespace rondo::study {

using io::ContactForce;
using io::Snapshot;

/// Fills and returns `snapshot` from a state of a motion: fields, contacts, position of the frame.
/// On a loaded rim the angle at the velocity's time is the mean over both ends of the step.
Snapshot& fill_snapshot(const Setup& setup, const dynamics::State& state, Snapshot& snapshot);

}  // namespace rondo::study

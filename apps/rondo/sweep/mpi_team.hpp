// SPDX-License-Identifier: BSD-3-Clause
/// @file  A sweep's team of MPI ranks: `mpirun -n N rondo sweep ...` (docs/clusters.md).
#pragma once
#include <memory>

#include "rondo/study/sweep/sweep_team.hpp"

namespace rondo::app {

/// Whether this process was started as one of several ranks, by mpirun or by a scheduler, according
/// to its environment.
[[nodiscard]] bool is_started_by_mpi();

/// Starts MPI, which ends with the object. Ranks take pieces by incrementing a counter in the
/// memory of rank 0, which must therefore call MPI from time to time: see tick().
/// @param stop set: no new piece starts, and running ones are told
[[nodiscard]] std::unique_ptr<study::Team> make_mpi_team(const std::atomic<bool>& stop);

}  // namespace rondo::app

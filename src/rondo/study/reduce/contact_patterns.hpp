// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact points learned from runs: few non-negative patterns of normal forces over the
/// places that stand still in space (docs/reduced.md, 11).
#pragma once
#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "rondo/io/run_reader.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"

namespace rondo::study {

/// How the patterns were found.
struct PatternFigures {
  long long snapshots = 0;  ///< with contact
  double left = 0.0;        ///< ‖what the patterns leave of the forces‖ / ‖forces‖
  int sweeps = 0;
};

struct ContactPatterns {
  Eigen::MatrixXd weights;  ///< (sectors, patterns) >= 0, columns of sum 1
  PatternFigures figures;
};

/// (sectors, snapshots with contact) normal forces at the places of the sectors, each shared by the
/// two places next to its node, the more the nearer. [N/m] @pre smooth disks of one mesh
[[nodiscard]] Eigen::MatrixXd standing_forces(std::span<const io::RunReader> runs,
                                              std::span<const Column> columns);

/// @param columns snapshots of displacements: contact has their times
/// @param warn may be empty: fewer patterns than asked for hold all
/// @throws InputError: no contact in any of the snapshots
[[nodiscard]] ContactPatterns learn_patterns(std::span<const io::RunReader> runs,
                                             std::span<const Column> columns, long long patterns,
                                             const std::function<void(const std::string&)>& warn);

}  // namespace rondo::study

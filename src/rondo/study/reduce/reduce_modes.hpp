// SPDX-License-Identifier: BSD-3-Clause
/// @file  The modes of one field for a reduced model: their norm and their number (docs/reduced.md,
/// 3).
#pragma once
#include <optional>

#include "rondo/analysis/build/build.hpp"
#include "rondo/pod/decompose.hpp"
#include "rondo/study/pod/pod_snapshots.hpp"
#include "rondo/study/reduce/reduce.hpp"

namespace rondo::study {

/// The requested number of modes of a field.
struct WantedModes {
  const char* field = "";
  std::optional<long long> modes;
  std::optional<double> tolerance;  ///< share of the energy left out, in the mass norm
  long long otherwise = 0;
};

/// Modes of one field in the order of the mesh, multiplied by √M.
struct FieldModes {
  ReducePart report;
  Eigen::MatrixXd modes;  ///< (2n, modes) orthonormal
  /// The first modes in the mass norm with all snapshots in them, and the values of those modes at
  /// the touched nodes: modes_without() chooses from them. Empty without an error estimate.
  pod::Decomposition found;
  Eigen::MatrixXd at_touched;
};

/// Nodes whose motion counts in the norm in addition to the mass: those in contact or nearly so.
struct TouchedNodes {
  std::vector<std::size_t> node;
  std::vector<double> weight;  ///< mass added to the node's own [kg/m]
};

/// The candidates at the angles in space where one of the runs touched the ground, widened by a
/// third of these on either side; in the rotating frame all. Weights are proportional to their
/// lengths; their sum is contact_weight times the mass. Empty if nothing touched, or it is 0.
[[nodiscard]] TouchedNodes touched_nodes(const Setup& setup, const std::vector<io::RunReader>& runs,
                                         const ReduceRequest& request);

/// @param snapshots of the field, weighted by mass. @param roots mass_roots()
/// @throws InputError: nothing moves
[[nodiscard]] FieldModes modes_of_field(const ReduceRequest& request, RunSnapshots snapshots,
                                        const Eigen::VectorXd& roots, const TouchedNodes& touched,
                                        const WantedModes& wanted);

/// As many modes as `field` has, of all snapshots except those of one run, chosen among the first
/// modes of all. @param columns the snapshots from which `field` was made
[[nodiscard]] Eigen::MatrixXd modes_without(const FieldModes& field,
                                            std::span<const SnapshotColumn> columns,
                                            std::size_t run);

/// Share of the energy of the snapshots outside the modes.
[[nodiscard]] double energy_left(RunSnapshots snapshots, const Eigen::MatrixXd& modes,
                                 const Eigen::VectorXd& roots);

}  // namespace rondo::study

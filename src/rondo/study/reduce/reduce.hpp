// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo reduce`: from the snapshots of one or several runs to a reduced model that
/// `rondo run --reduced` runs (docs/reduced.md).
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/error_estimate.hpp"

namespace rondo::study {

/// Measured to be enough for forces on three meshes (docs/reduced.md, 8).
inline constexpr long long default_displacement_modes = 30, default_velocity_modes = 30;

/// Round the disk: more resolve a contact that spans a twentieth of it no better, and cost more.
inline constexpr int enough_contact_points = 180;
/// Fewer means of several nodes lie too far inside of the rim.
inline constexpr int least_contact_points = 48;

/// What the user asks for, in the command line's words.
struct ReduceRequest {
  std::vector<std::filesystem::path> runs;  ///< results directories of one mesh and material
  std::filesystem::path output;             ///< the model's file
  /// Of the two PODs; none: by the tolerances, and without these the default numbers.
  std::optional<long long> displacement_modes, velocity_modes;
  std::optional<double> displacement_tolerance, velocity_tolerance;  ///< energy left out
  double contact_weight = 10.0;  ///< of what touches in the norm of the PODs, over that of the mass
  std::optional<double> from, to;  ///< window of the snapshots [s]
  int contact_stride = 0;  ///< nodes of the boundary to a contact point; 0: as many as leave
                           ///<     enough_contact_points
  int contact_phases = 1;  ///< points to a node of the boundary; above 1 only without a stride
  std::string frame = "rectified";  ///< or "co-rotating"
  std::string contact;              ///< contact_names; empty: what suits the disk and the frame
  bool error_estimate = true;       ///< leaves each run out in turn, where there are 3 or more
  std::string memory = "2GB";
  std::function<void(const std::string&)> warn;        ///< may be empty
  std::function<void(long long, long long)> progress;  ///< done, of all; may be empty
};

/// Of one of the two PODs.
struct ReducePart {
  std::string field;
  long long snapshots = 0, modes = 0;
  double discarded = 0.0;  ///< share of the energy that the modes leave out
};

struct ReduceReport {
  long long dofs = 0;   ///< of the full model
  long long modes = 0;  ///< r: displacement modes, their derivatives by the angle, velocity modes
  ReducePart displacement, velocity;
  double displacement_left = 0.0;      ///< share of the energy that all r modes leave out
  double velocity_left = 0.0;          ///< likewise
  double full_critical_step = 0.0;     ///< [s]
  double reduced_critical_step = 0.0;  ///< of explicit central differences on the modes [s]
  double contact_step = 0.0;  ///< in which the fastest spin passes one contact point [s]; 0: none
  std::string contact;        ///< its form
  long long contact_points = 0;
  ErrorEstimate estimate;
  std::size_t file_bytes = 0;
  double wall_s = 0.0;
};

/// @throws InputError: runs that cannot be reduced, together or at all; FileError
[[nodiscard]] ReduceReport run_reduce(const ReduceRequest& request);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  `rondo reduce`: makes a reduced model for `rondo run --reduced` from the snapshots of one
/// or several runs (docs/reduced.md).
#pragma once
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/error_estimate.hpp"

namespace rondo::study {

/// Measured to be sufficient for forces on three meshes (docs/reduced.md, 8).
inline constexpr long long default_displacement_modes = 30, default_velocity_modes = 30;

/// Around the disk: more points resolve a contact that spans 1/20 of it no better, and cost more.
inline constexpr int enough_contact_points = 180;
/// With fewer, the means of several nodes lie too far inside the circumference.
inline constexpr int least_contact_points = 48;

/// The user's request in the words of the command line.
struct ReduceRequest {
  std::vector<std::filesystem::path> runs;  ///< results directories, same mesh and material
  std::filesystem::path output;             ///< the model's file
  /// Of the two PODs; none: by the tolerances, without which the default numbers are used.
  std::optional<long long> displacement_modes, velocity_modes;
  std::optional<double> displacement_tolerance, velocity_tolerance;  ///< energy left out
  double contact_weight = 10.0;    ///< of touched nodes in the norm of the PODs, relative to mass
  std::optional<double> from, to;  ///< window of the snapshots [s]
  int contact_stride = 0;  ///< nodes of the boundary per contact point; 0: such that there are
                           ///<     enough_contact_points
  int contact_phases = 1;  ///< contact points per boundary node; above 1 only without a stride
  std::string frame = "rectified";  ///< or "co-rotating"
  std::string contact;              ///< one of contact_names; empty: what suits the disk and frame
  bool error_estimate = true;       ///< leave each run out in turn, if there are 3 or more
  std::string memory = "2GB";
  std::function<void(const std::string&)> warn;        ///< may be empty
  std::function<void(long long, long long)> progress;  ///< done, total; may be empty
};

/// Result of one of the two PODs.
struct ReducePart {
  std::string field;
  long long snapshots = 0, modes = 0;
  double discarded = 0.0;  ///< share of the energy outside the modes
};

struct ReduceReport {
  long long dofs = 0;   ///< of the full model
  long long modes = 0;  ///< r: displacement modes, their angle derivatives, velocity modes
  ReducePart displacement, velocity;
  double displacement_left = 0.0;      ///< share of the energy outside all r modes
  double velocity_left = 0.0;          ///< share of the energy outside all r modes
  double full_critical_step = 0.0;     ///< [s]
  double reduced_critical_step = 0.0;  ///< of explicit central differences with these modes [s]
  double contact_step = 0.0;  ///< for the fastest spin to pass one contact point [s]; 0: none
  std::string contact;        ///< its form
  long long contact_points = 0;
  ErrorEstimate estimate;
  std::size_t file_bytes = 0;
  double wall_s = 0.0;
};

/// @throws InputError: runs that cannot be reduced, together or at all; FileError
[[nodiscard]] ReduceReport run_reduce(const ReduceRequest& request);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  rondo modes: frequencies, shapes and critical speeds of a case's body (docs/modes.md).
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "rondo/analysis/modes/standing.hpp"
#include "rondo/case/case.hpp"
#include "rondo/modal/critical_speeds.hpp"
#include "rondo/modal/modes.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

struct ModesRequest {
  RunOptions run;             ///< directory, overwrite, signals, progress and warnings of it
  int count = 20;             ///< modes at each spin, besides rigid-body motions
  std::vector<double> spins;  ///< angular velocities ω; none: rest, and that of the case [rad/s]
  std::string sweep;          ///< "FROM:TO:NUMBER": a Campbell table; empty: none
  int diameters = 12;         ///< largest n of the critical speeds
  bool standing = false;      ///< a wheel in three dimensions is held where it touches the ground
};

/// A line of modes.csv.
struct ModeLine {
  double angular_velocity = 0.0;  ///< value of the case, > 0 rolls towards +x         [rad/s]
  double omega = 0.0;             ///< frequency in the co-rotating frame              [rad/s]
  int diameters = -1;             ///< -1: unknown
  modal::Wave wave = modal::Wave::unknown;
  double residual = 0.0;
  double damping_ratio = 0.0;  ///< NaN of a rigid-body motion
};

struct SpinSummary {
  double angular_velocity = 0.0;  ///< [rad/s]
  int modes = 0, rigid = 0, unstable = 0, dimension = 0;
  bool counted = false;
  double growth = 0.0;  ///< growth of the rotation of a free disk [1/s]
};

struct ModesReport {
  std::filesystem::path directory;
  std::vector<ModeLine> modes;
  std::vector<SpinSummary> spins, sweep;
  std::vector<modal::CriticalSpeed> critical;
  std::optional<Standing> on_ground{};  ///< how, of a wheel that stands
  double outer_radius = 0.0;            ///< [m]; 0: no disk
  std::size_t nodes = 0, dofs = 0;
  double residual_max = 0.0;
  double wall_s = 0.0;
  RunReport run;  ///< failed: spins beyond the softening limit, or a residual out of bound
};

/// Residual above which a mode is called wrong: round-off of K u is far below it.
inline constexpr double mode_residual_bound = 1e-6;

/// @throws InputError (nothing is left behind), FileError
[[nodiscard]] ModesReport run_modes(const Case& c, const ModesRequest& request);

/// "standing", "forward", ...; empty: unknown.
std::string name_of(modal::Wave wave);

}  // namespace rondo::study

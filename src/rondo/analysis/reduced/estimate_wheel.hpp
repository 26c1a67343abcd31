// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far off the forces of a reduced wheel may be, without a full run (docs/reduced.md):
/// the wheel is run again with half the step, and with twice the modes.
#pragma once
#include <limits>
#include <string>

#include "rondo/case/case.hpp"
#include "rondo/output/run_options.hpp"

namespace rondo::study {

/// Errors of means of forces over the mean vertical force, and of what is often small beside it,
/// over itself.
struct ForceErrors {
  double x = 0.0, y = 0.0;
  double lateral = 0.0, aligning = 0.0;  ///< in three dimensions; the moment over F_y is in m
  /// NaN: there is next to none of it, |F_x| below a thousandth of F_y or no friction.
  double x_of_itself = std::numeric_limits<double>::quiet_NaN();
  double friction_power = std::numeric_limits<double>::quiet_NaN();
};

struct WheelEstimate {
  std::string none;  ///< why there is none; empty: there is one
  /// Differences of the means over the last quarter: run minus other run, with half the step and
  /// with twice the modes.
  ForceErrors step, modes;

  /// The larger of each; NaN where neither run has one.
  [[nodiscard]] ForceErrors larger() const noexcept;
};

/// With modes of a file, the run with twice the modes takes eigenmodes.
/// @param options of the run, whose step and number of modes are as given
/// @param step [s] and n_modes of the run
[[nodiscard]] WheelEstimate estimate_wheel(const Case& c, const RunOptions& options, double step,
                                           int n_modes);

std::string in_words(const WheelEstimate& estimate);

}  // namespace rondo::study

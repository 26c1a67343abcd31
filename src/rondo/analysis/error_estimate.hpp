// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far off a reduced model may be (docs/reduced.md, 8b).
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace rondo::study {

/// Errors of means of forces over the mean vertical force, and of what is often small beside it,
/// over itself.
struct ForceErrors {
  double x = 0.0, y = 0.0;
  /// NaN: there is next to none of it, |F_x| below least_share of F_y or no friction.
  double x_of_itself = std::numeric_limits<double>::quiet_NaN();
  double friction_power = std::numeric_limits<double>::quiet_NaN();
};

/// A mean F_x that is a smaller share of F_y is a difference of larger forces: no error is told by
/// it.
inline constexpr double least_share = 1e-3;

/// Times the largest error of a run left out: the runs stand at the corners of their range, where
/// most of the contact slides, and friction is more sensitive in between. Measured to cover most
/// predictions (docs/reduced.md, 8b).
inline constexpr double estimate_over_largest = 2.0;

/// The likely error of a prediction, from the errors of the runs behind the model, each predicted
/// from the others.
struct ErrorEstimate {
  std::vector<std::string> runs;    ///< those that were left out in turn
  std::vector<ForceErrors> errors;  ///< errors of each run, with their sign
  std::string none;                 ///< why there are none; empty: there are

  /// The largest of each, times estimate_over_largest; NaN where no run has one. @pre there are
  /// errors
  [[nodiscard]] ForceErrors estimate() const noexcept;
};

/// "F_x 1.2 %, F_y 0.3 % of F_y (twice the largest of 8 runs, each predicted from the others); over
/// themselves F_x 14 %, friction power 30 %", or that there is none and why.
std::string in_words(const ErrorEstimate& estimate);

}  // namespace rondo::study

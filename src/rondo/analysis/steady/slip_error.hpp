// SPDX-License-Identifier: BSD-3-Clause
/// @file  How far the forces along the ground differ between the two differences that the slip is
/// taken by (docs/steady.md, The two formulas of the slip). Both tend to the same force as samples
/// are added, most often from opposite sides: the difference is a measure of the error, no bound.
#pragma once
#include <optional>
#include <string>

#include "rondo/case/case.hpp"
#include "rondo/statics/steady/rolling_problem.hpp"

namespace rondo::study {

inline constexpr double slip_error_told = 0.03;  ///< share above which the run warns

/// Forces by the upwind difference less those by bdf2.
struct SlipError {
  statics::RollingForces difference;
  double share = 0.0;  ///< of the force along the ground, over the mean of both; NaN without any
};

[[nodiscard]] SlipError slip_error_of(const statics::RollingForces& upwind,
                                      const statics::RollingForces& bdf2) noexcept;

/// For the user; empty: the error is small, or the force is less than a hundredth of the load.
/// @param found none: the other difference was not solved. @param used the forces of the state
[[nodiscard]] std::string slip_warning(const Case& c, const std::optional<SlipError>& found,
                                       const statics::RollingForces& used);

}  // namespace rondo::study

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini's and Coulomb's law on the pairs of steady rolling in three dimensions
/// (docs/wheel3d.md). Method: Newton on statuses and directions of sliding, semi-smooth (Alart,
/// Curnier, CMAME 92 (1991) 353; Hüeber, Stadler, Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572),
/// from the contact without friction; where it does not end, pair after pair as the material passes
/// them (Jourdan, Alart, Jean, CMAME 155 (1998) 31; Vollebregt's SteadyGS), and Newton from there.
#pragma once
#include <Eigen/Core>
#include <limits>

#include "rondo/statics/steady_solid/solid_system.hpp"

namespace rondo::statics {

/// Of the relative residual of a solution.
inline constexpr double solid_residual_bound = 1e-10;

/// Where this much work brought no solution there is none to wait for: half a minute.
inline constexpr double most_solid_work = 2e11;

struct SolidRollingState {
  SolidRollingPoint point;
  SolidStatuses statuses;
  /// Of the law, relative; infinite: nothing was solved yet                                   [-]
  double residual = std::numeric_limits<double>::infinity();
  SolidRollingSlopes slopes;  ///< of what is solved
  bool touches = true;        ///< false: nothing is closed
  int newton_steps = 0, sweeps = 0;
  double work = 0.0;  ///< of these, roughly, in floating-point operations

  [[nodiscard]] bool solved() const noexcept { return touches && residual <= solid_residual_bound; }
};

/// Largest law residual over the largest force, each pair's own scaled by its compliance.
[[nodiscard]] double solid_residual(const SolidRollingProblem& problem, double slip_angle,
                                    const SolidRollingPoint& point, double friction);

/// From the height, the speed and the forces of the state on.
/// @param back of a sample, the one before: -1 or 1
void solve_rolling(const SolidRollingProblem& problem, const SolidRollingDrive& drive, int back,
                   SolidRollingState& state);

}  // namespace rondo::statics

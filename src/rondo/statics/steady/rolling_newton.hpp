// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini's and Coulomb's law on the pairs of a rolling problem (docs/theory.md, 11.3).
/// Method: Newton on statuses, the primal-dual active set (Alart, Curnier, CMAME 92 (1991) 353;
/// Hüeber, Stadler, Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572), started from the solution on
/// groups of pairs; Lemke's pivoting where it cycles.
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "rondo/statics/steady/rolling_system.hpp"

namespace rondo::statics {

/// Of the relative residual of a solution.
inline constexpr double rolling_residual_bound = 1e-9;

struct RollingState {
  std::vector<RollingStatus> found;  ///< (pairs)
  RollingPoint point;
  /// Of the law, relative (6.4d); infinite: nothing was solved yet                            [-]
  double residual = std::numeric_limits<double>::infinity();
  RollingSlopes slopes;  ///< of what is solved
  bool touches = true;   ///< false: the active set that was left is empty
  int newton_steps = 0, pivots = 0;
  double work = 0.0;  ///< of these, roughly, in floating-point operations

  [[nodiscard]] bool solved() const noexcept {
    return touches && residual <= rolling_residual_bound;
  }
};

/// Largest law residual over the largest force, each pair's own scaled by its compliance.
[[nodiscard]] double rolling_residual(const RollingProblem& problem, const RollingPoint& point,
                                      double friction);

/// Statuses near those of the solution, by groups of pairs. @param point to start from: of a drive
/// with a load its height must be in the ground
[[nodiscard]] RollingState rolling_start(const RollingProblem& problem, const RollingDrive& drive,
                                         const RollingPoint& point);

/// Where this much work brought no solution there is none to wait for: half a minute.
inline constexpr double most_rolling_work = 4e11;

/// From `state` on; where Newton's method does not end, by pivoting, at a given height and speed;
/// else by Newton's method on these, each trial at a given height and speed.
void solve_rolling(const RollingProblem& problem, const RollingDrive& drive, RollingState& state);

}  // namespace rondo::statics

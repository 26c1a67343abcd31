// SPDX-License-Identifier: BSD-3-Clause
/// @file  Signorini's and Coulomb's law on the pairs of a rolling problem (docs/theory.md, 11.3,
/// and docs/wheel3d.md). Method: Newton on statuses and, in space, on directions of sliding,
/// semi-smooth (Alart, Curnier, CMAME 92 (1991) 353; Hüeber, Stadler, Wohlmuth, SIAM J. Sci.
/// Comput. 30 (2008) 572). Where to start and what to do where it does not end depend on the law of
/// a pair (rolling_law.hpp).
#pragma once
#include <Eigen/Core>
#include <limits>
#include <vector>

#include "rondo/statics/steady/rolling_system.hpp"

namespace rondo::statics {

/// Bound of the relative residual of a solution, that of every solver's law.
inline constexpr double rolling_residual_bound = 1e-9;

/// What was done for a solution.
struct RollingEffort {
  int newton_steps = 0;
  int pivots = 0;     ///< in the plane
  int sweeps = 0;     ///< in space
  double work = 0.0;  ///< of these, roughly, in floating-point operations
  /// Where this much work brought no solution there is none to wait for: half a minute, in space
  /// more for many pairs.
  double most = 4e11;

  [[nodiscard]] bool spent() const noexcept { return work >= most; }
};

/// How coefficients were found that depend on slip speed and pressure (rolling_friction.hpp).
struct FrictionEffort {
  int steps = 0;         ///< from the constant coefficient to the law; 0: near a state that had it
  int restarts = 0;      ///< with half a step, where one did not end
  int problems = 0;      ///< of contact, with given coefficients
  double share = 1.0;    ///< of the departure from the constant coefficient that was reached
  bool solved = true;    ///< false: the coefficients of the next step of the share did not settle
  double change = 0.0;   ///< of a coefficient in the last iteration, the largest               [-]
  std::size_t pair = 0;  ///< whose coefficient that is
};

struct RollingState {
  RollingPoint point{};
  RollingStatuses statuses{};  ///< (pairs)
  /// Residual of the law, relative (6.4d); infinite: nothing was solved yet [-]
  double residual = std::numeric_limits<double>::infinity();
  RollingSlopes slopes{};  ///< of what is solved; in space once add_slopes() finds them
  bool touches = true;     ///< false: nothing is closed
  RollingEffort effort{};
  std::vector<PairFriction> pairs{};  ///< (pairs) by the law of friction; empty: factors of 1
  FrictionEffort friction{};

  [[nodiscard]] bool solved() const noexcept {
    return touches && residual <= rolling_residual_bound;
  }
};

/// Largest law residual over the largest force, each pair's own scaled by its compliance.
template <int D>
[[nodiscard]] double rolling_residual(const RollingProblem<D>& problem, const RollingPoint& point,
                                      const RollingPath& path, const PairCoefficients& friction);

/// From the height, the speed and the forces of the state on, in the plane from its statuses if it
/// has some. In space the forces of a state that is solved, of fewer pairs or at another height,
/// are near the solution. With a law of friction the coefficients of the state are, if it has some.
template <int D>
void solve_rolling(const RollingProblem<D>& problem, const RollingDrive& drive,
                   RollingState& state);

/// Finds the slopes of a solved state in space, which takes as long as some steps of Newton's
/// method. A state that is not solved has none.
void add_slopes(const RollingProblem<3>& problem, const RollingDrive& drive, RollingState& state);

}  // namespace rondo::statics

// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling body with flat ground (docs/theory.md, 11.2 and 11.3, and
/// docs/wheel3d.md): Signorini's and Coulomb's law on the pairs of a window, at a given height and
/// speed or at a given load, traction or torque, and how the forces change with each of these.
/// Method: rolling_newton.hpp. With D = 2, in the plane, forces are per metre of width.
#pragma once
#include <Eigen/Core>

#include "rondo/statics/steady/rolling_newton.hpp"
#include "rondo/statics/steady/rolling_window.hpp"

namespace rondo::statics {

enum class RollingEnd {
  solved,
  not_solved,  ///< nothing that was tried met the law
  no_contact,  ///< nothing touches: with a load, none could be borne
  sliding      ///< the speed is asked for, and all slides: traction does not depend on it
};

struct RollingSolution {
  RollingEnd end = RollingEnd::not_solved;
  double height = 0.0, speed = 0.0;  ///< [m], [m/s]
  RollingPath path{};                ///< that of the drive
  Eigen::VectorXd force{};           ///< (D pairs) along n, t1, t2                            [N]
  Eigen::VectorXd gap_and_slip{};    ///< (D pairs) [m], [m/s]
  Eigen::VectorXd place{};           ///< ((D - 1) pairs) along t1 and t2 from the center      [m]
  RollingStatuses status{};          ///< (pairs)
  RollingForces forces{};
  RollingEffort effort{};
  double residual = 0.0;  ///< of the law, relative (6.4d)                                   [-]
  RollingSlopes slopes{};
  /// (pairs) With a law of friction: what the coefficient of each pair is over the drive's; else
  /// empty.
  std::vector<PairFriction> pairs{};
  FrictionEffort friction{};
};

/// The window grows by the pairs that are missing. With a law of friction the state is reached from
/// that of the constant coefficient (rolling_friction.hpp).
/// @param from statuses to start from, of the window's first pairs, in the plane
template <int D>
[[nodiscard]] RollingSolution solve_rolling(RollingWindow<D>& window, const RollingDrive& drive,
                                            const RollingStatuses& from = {});

/// The same, in space, from a solution of the same window under other forces: what touched there is
/// near what touches now. With a law of friction, in the plane as well, its coefficients are as
/// near.
template <int D>
[[nodiscard]] RollingSolution solve_rolling_from(RollingWindow<D>& window,
                                                 const RollingDrive& drive,
                                                 const RollingSolution& near);

/// Largest law residual over the largest force, each pair's own scaled by its compliance, from the
/// window's rows alone: independent of how the forces were found.
template <int D>
[[nodiscard]] double rolling_residual(const RollingWindow<D>& window, const RollingSolution& s,
                                      const PairCoefficients& friction) {
  return rolling_residual(window.problem(), {s.force, s.height, s.speed}, s.path, friction);
}

}  // namespace rondo::statics

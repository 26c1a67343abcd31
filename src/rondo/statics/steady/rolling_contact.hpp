// SPDX-License-Identifier: BSD-3-Clause
/// @file  Contact of a steadily rolling body with flat ground (docs/theory.md, 11.2 and 11.3):
/// Signorini's and Coulomb's law on the pairs of a window, at a given height and speed or at a
/// given load, traction or torque, and how the forces change with each of these. Method: Newton on
/// statuses, the primal-dual active set (Alart, Curnier, CMAME 92 (1991) 353; Hüeber, Stadler,
/// Wohlmuth, SIAM J. Sci. Comput. 30 (2008) 572); Lemke's pivoting where it cycles.
#pragma once
#include <Eigen/Core>
#include <vector>

#include "rondo/statics/steady/rolling_system.hpp"
#include "rondo/statics/steady/rolling_window.hpp"

namespace rondo::statics {

enum class RollingEnd {
  solved,
  not_solved,  ///< neither Newton nor pivoting met the law
  no_contact,  ///< nothing touches: with a load, none could be borne
  sliding      ///< the speed is asked for, and all slides: traction does not depend on it
};

struct RollingSolution {
  RollingEnd end = RollingEnd::not_solved;
  double height = 0.0, speed = 0.0;   ///< [m], [m/s]
  Eigen::VectorXd force;              ///< (2 pairs) r_n, r_x                               [N/m]
  Eigen::VectorXd gap_and_slip;       ///< (2 pairs) [m], [m/s]
  std::vector<RollingStatus> status;  ///< (pairs)
  RollingForces forces;
  int newton_steps = 0, pivots = 0;
  double residual = 0.0;  ///< of the law, relative (6.4d)                                   [-]
  RollingSlopes slopes;
};

/// Distance of the lowest contact node from the center where nothing touches, as spin, gravity and
/// loads leave it [m].
[[nodiscard]] double lowest_place(const RollingWindow& window);

/// The window grows by the pairs that are missing.
/// @param from statuses to start from, of the window's first pairs
[[nodiscard]] RollingSolution solve_rolling(RollingWindow& window, const RollingDrive& drive,
                                            const std::vector<RollingStatus>& from = {});

/// Largest law residual over the largest force, each pair's own scaled by its compliance, from the
/// window's rows alone: independent of how the forces were found.
[[nodiscard]] double rolling_residual(const RollingWindow& window, const RollingSolution& solution,
                                      double friction);

}  // namespace rondo::statics
